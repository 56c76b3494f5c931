#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vesselbench {

/// Directions of a file's coordinates x, y, z in the patient: to the left, back and head (LPS,
/// ours) or to the right, front and head (RAS).
enum class PatientAxes { Lps, Ras };

[[nodiscard]] std::string to_string(PatientAxes axes);  ///< "lps", "ras"

/// The axes after "SPACE=" in a header or comment, as 3D Slicer writes them; none: neither.
[[nodiscard]] std::optional<PatientAxes> stated_axes(std::string_view text);

/// The same for the value alone: "RAS".
[[nodiscard]] std::optional<PatientAxes> axes_named(std::string_view name);

}  // namespace vesselbench
