#pragma once

#include <array>
#include <optional>
#include <string>

#include "workbench/window/features/slices/slice_pane.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The part of the 3D view's rectangle that the row of slices takes: its lower half.
[[nodiscard]] ScreenRect slice_row_rect(const ScreenRect& view);

/// The image as a row of 2D views, under a line with window, level, and the value under the cursor.
class SliceRow {
public:
    /// Needs the window's OpenGL context, as the destructor does.
    void draw(PanelContext& context, const PaneSource& source, const ScreenRect& rect);

private:
    /// A number's text while it is typed.
    struct Typed {
        std::string text;
        bool typing = false;
    };

    void draw_header(PanelContext& c, const ScreenRect& rect);
    void draw_grey(PanelContext& c, bool narrow);
    void draw_toggles(PanelContext& c) const;
    void draw_pointed(PanelContext& c, float right) const;
    [[nodiscard]] static std::optional<double> edit(PanelContext& c, const std::string& name,
                                                    Typed& number, double value);

    std::array<SlicePane, 3> panes_ = {SlicePane(SlicePlane::Axial), SlicePane(SlicePlane::Coronal),
                                       SlicePane(SlicePlane::Sagittal)};
    Typed window_, level_;
};

}  // namespace vesselbench
