#include "geometry/formats/patient_axes.h"

#include "geometry/kernel/wording.h"

namespace vesselbench {

std::string to_string(PatientAxes axes) {
    return axes == PatientAxes::Ras ? "ras" : "lps";
}

std::optional<PatientAxes> stated_axes(std::string_view text) {
    constexpr std::string_view kKey = "space=";
    const std::string lower = lower_case(text);
    const auto at = lower.find(kKey);
    if (at == std::string::npos) return std::nullopt;
    return axes_named(std::string_view(lower).substr(at + kKey.size(), 3));
}

std::optional<PatientAxes> axes_named(std::string_view name) {
    const std::string lower = lower_case(name);
    if (lower == "ras") return PatientAxes::Ras;
    if (lower == "lps") return PatientAxes::Lps;
    return std::nullopt;
}

}  // namespace vesselbench
