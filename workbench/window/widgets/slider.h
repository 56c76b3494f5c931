#pragma once

#include <string>

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

struct SliderLook {
    double least = 0.0, most = 1.0;
    std::string text = {};  ///< over it: the value in words
    float width = -1.0F;    ///< [pixels]; -1: all that is left
    std::string help = {};
};

/// A value to be dragged. \return true when it has changed
bool slider(Ui& ui, const std::string& name, double& value, const SliderLook& look);

}  // namespace vesselbench
