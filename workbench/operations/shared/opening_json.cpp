#include "workbench/operations/shared/opening_json.h"

#include <nlohmann/json.hpp>

#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

nlohmann::ordered_json opening_json(const Surface& surface, const PatchMeasures& patch, Keys keys) {
    nlohmann::ordered_json opening = patch_json(patch, keys);
    const auto axis = axis_at_patch(surface, patch.row);
    opening["tilt_deg"] = axis ? nlohmann::ordered_json(axis->tilt_deg) : nullptr;
    opening["bend_deg"] = axis ? nlohmann::ordered_json(axis->bend_deg) : nullptr;
    return opening;
}

}  // namespace vesselbench
