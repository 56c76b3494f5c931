#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "gpu/picture.h"
#include "workbench/window/case/document.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/drawing/picture_look.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

/// Saves what is seen in the view as a PNG file, when the workplace was given one.
class ViewPicture {
public:
    /// \param wake as Viewport's
    explicit ViewPicture(std::function<void()> wake);
    ~ViewPicture();

    ViewPicture(const ViewPicture&) = delete;
    ViewPicture& operator=(const ViewPicture&) = delete;

    /// Draws the model alone. \param background none: the theme's
    using Draw = std::function<Picture(int factor, const std::optional<Colour>& background)>;

    /// Once a frame.
    /// \param draw null: the view shows more than the model, and is saved as it is seen
    /// \return true if this frame is to be saved: it should show no controls
    /// \throw what draw throws
    [[nodiscard]] bool update(PanelContext& context, const ScreenRect& view, const Draw& draw);

    /// Tells what became of a picture; part of update().
    void collect(Document& document);

    [[nodiscard]] bool pending() const;

private:
    void save(const std::filesystem::path& file, const PictureLook& look, const Draw& draw);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
