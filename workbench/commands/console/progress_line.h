#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vesselbench {

/// What is left of a computation, by its speed so far.
/// \param fraction done, in [0, 1]
/// \param elapsed since its begin [s]
/// \return [s]; none: too little is done, or too little time has passed, to tell
[[nodiscard]] std::optional<double> remaining_time(double fraction, double elapsed);

/// " 45 %  remesh, about 20 s left"; without the time while it is unknown.
[[nodiscard]] std::string progress_text(double fraction, std::string_view what, double elapsed);

/// "[######......]  45 %  remesh, about 20 s left", cut to `width` columns.
[[nodiscard]] std::string progress_bar(double fraction, std::string_view what, double elapsed,
                                       std::size_t width);

}  // namespace vesselbench
