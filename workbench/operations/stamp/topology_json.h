#pragma once

#include <nlohmann/json.hpp>

namespace vesselbench {

/// Adds parts and handles before and after, as every operation reports them that puts other wall in
/// the place of some.
/// \param figures StampReport or SeparateReport
template <class Report>
void add_topology(nlohmann::ordered_json& report, const Report& figures) {
    report["components_before"] = figures.components_before;
    report["components_after"] = figures.components_after;
    report["genus_before"] = figures.genus_before;
    report["genus_after"] = figures.genus_after;
}

}  // namespace vesselbench
