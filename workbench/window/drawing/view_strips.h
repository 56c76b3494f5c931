#pragma once

#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Plates with controls in the lower middle of the view, one above the other.
class ViewStrips {
public:
    /// Within the view's ImGui window.
    explicit ViewStrips(const ScreenRect& view) : view_(view) {}

    /// A plate for controls of a width, at whose left end ImGui's cursor is put. They follow each
    /// other by next(). \return the width that there is for them: at most `width` [pixels]
    float begin(const Ui& ui, const std::string& name, float width);

    /// Puts ImGui's cursor beside the last control.
    static void next(const Ui& ui);

private:
    ScreenRect view_;
    float above_ = 0.0F;  ///< height of the plates so far [pixels]
};

}  // namespace vesselbench
