#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "workbench/window/panels/panel_context.h"

namespace vesselbench {

/// Saves what is seen in the view as a PNG file, when the workplace was given one.
class ViewPicture {
public:
    /// \param wake as Viewport's
    explicit ViewPicture(std::function<void()> wake);
    ~ViewPicture();

    ViewPicture(const ViewPicture&) = delete;
    ViewPicture& operator=(const ViewPicture&) = delete;

    /// Once a frame. \return true if this frame is to be saved: it should show no controls
    [[nodiscard]] bool update(PanelContext& context, const ScreenRect& view);

    /// Tells what became of a picture; part of update().
    void collect(Document& document);

    [[nodiscard]] bool pending() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
