#include "workbench/window/features/handles/handles_feature.h"

namespace vesselbench {

bool HandlesFeature::update() {
    offered_.update(core_.document.current(), core_.open_form());
    return false;
}

}  // namespace vesselbench
