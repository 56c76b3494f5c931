#pragma once

#include <span>
#include <string>
#include <vector>

namespace vesselbench {

/// Settings "clip-opening.parameter=value" that name vessel ends.
/// \param what "inlet", "open" or "close"
/// \param texts each with numbers of ends, "1" or "4,7", or a place "x,y,z" [mm]
/// \throw UsageError if a text is neither
[[nodiscard]] std::vector<std::string> end_settings(const std::string& what,
                                                    std::span<const std::string> texts);

}  // namespace vesselbench
