#pragma once

#include <functional>
#include <optional>

#include "gpu/render/pick.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/features/gallery/suggestion_gallery.h"
#include "workbench/window/features/picking/view_places.h"

namespace vesselbench {

/// Makes spots of clicks on the model, chooses one by a click on its mark, and draws the marks.
class SpotPicker {
public:
    /// \param renderer must outlive it \param wake as Viewport's
    SpotPicker(Renderer& renderer, std::function<void()> wake);

    /// Once a frame, before the model is drawn.
    void update(PanelContext& context, const SeenModel& seen);

    void forget() { picker_.forget(); }

    [[nodiscard]] bool pending() const { return picker_.pending(); }

    void draw(PanelContext& context, const PixelView& screen) const;

private:
    void take(SuggestionGallery& gallery, const SeenModel& seen);

    Picker picker_;
    std::function<void()> wake_;
    int version_ = 0;  ///< of the model that was clicked
};

}  // namespace vesselbench
