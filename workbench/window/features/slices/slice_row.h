#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "workbench/window/core/layout.h"
#include "workbench/window/features/slices/slice_pane.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// The image as 2D views in a row, or in quarters with the model, or one of them enlarged; with a
/// line of window, level, and the value under the cursor.
class SliceRow {
public:
    /// Needs the window's OpenGL context, as the destructor does.
    void draw(PanelContext& context, const PaneSource& source, const ViewParts& parts);

private:
    /// A number's text while it is typed.
    struct Typed {
        std::string text;
        bool typing = false;
    };

    [[nodiscard]] std::vector<SlicePane*> panes_below(const PanelContext& c,
                                                      const ViewParts& parts);
    void draw_header(PanelContext& c, const ScreenRect& rect);
    void draw_grey(PanelContext& c, float room);
    void draw_grey_fields(PanelContext& c, float room);
    void draw_toggles(PanelContext& c) const;
    void draw_pointed(PanelContext& c, float right) const;
    [[nodiscard]] static std::optional<double> edit(PanelContext& c, const std::string& name,
                                                    Typed& number, double value);

    std::array<SlicePane, 3> panes_ = {SlicePane(SlicePlane::Axial), SlicePane(SlicePlane::Coronal),
                                       SlicePane(SlicePlane::Sagittal)};
    Typed window_, level_;
};

}  // namespace vesselbench
