#include "workbench/window/case/known_models.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

const KnownModel* KnownModels::find(ResultId result) const {
    const auto found = std::ranges::find(models_, result, &KnownModel::result);
    return found == models_.end() ? nullptr : &*found;
}

bool KnownModels::show(ResultId result) {
    const auto found = std::ranges::find(models_, result, &KnownModel::result);
    if (found == models_.end()) return false;
    models_.splice(models_.begin(), models_, found);
    return true;
}

void KnownModels::put(ResultId result, Scene scene) {
    std::erase_if(models_, [&](const KnownModel& model) { return model.result == result; });
    models_.push_front({.result = result, .scene = std::move(scene), .figures = {}});
}

void KnownModels::keep(ResultId result, int others) {
    const KnownModel* first = shown();
    std::erase_if(models_, [&](const KnownModel& model) {
        return &model != first && model.result != result && others-- <= 0;
    });
}

}  // namespace vesselbench
