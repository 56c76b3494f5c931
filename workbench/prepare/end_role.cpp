#include "workbench/prepare/end_role.h"

#include <algorithm>
#include <array>

namespace vesselbench {

namespace {

constexpr std::array kRoles = {EndRole::Inlet, EndRole::Open, EndRole::Closed};

}  // namespace

std::string to_string(EndRole role) {
    return role == EndRole::Inlet ? "inlet" : role == EndRole::Open ? "open" : "closed";
}

EndRole planned_role(const OpeningPlan& plan, const EndRecord& end) {
    if (!end.opening) return EndRole::Closed;
    const auto& patch = plan.openings[*end.opening].patch;
    const bool inlet = std::ranges::count(plan.inlets, *end.opening) > 0 ||
                       (patch && patch->kind == PatchKind::Inlet);
    return inlet ? EndRole::Inlet : EndRole::Open;
}

std::optional<EndRole> end_role(const std::string& text) {
    const auto role = std::ranges::find(kRoles, text, [](EndRole r) { return to_string(r); });
    return role == kRoles.end() ? std::nullopt : std::optional(*role);
}

}  // namespace vesselbench
