#pragma once

#include <filesystem>

#include "geometry/kernel/vec3.h"
#include "workbench/window/core/file_question.h"
#include "workbench/window/form/form_listener.h"

namespace vesselbench {

struct PanelContext;
struct ScreenRect;

/// A feature of the window: what it does by itself, and what it makes of the events of the case,
/// of its form and of the view. Its panel and its views are drawn by those that have room for them.
/// Used by one thread.
class Feature : public FormListener {
public:
    /// Once a frame, after what has ended was collected for the document.
    /// \return true if something shown has changed
    [[nodiscard]] virtual bool update() { return false; }

    /// True while something runs whose end changes what is shown.
    [[nodiscard]] virtual bool pending() const { return false; }

    /// Does what the frame's keys ask for (Shown::keys).
    virtual void keys(PanelContext&) {}

    /// Draws the feature's banner over the view, if it has one now.
    /// \param place whose top it takes
    /// \return its height [pixels]; 0: there is none
    [[nodiscard]] virtual float banner(PanelContext&, const ScreenRect& /*place*/) { return 0.0F; }

    /// Another case was opened.
    virtual void case_opened() {}

    virtual void case_closed() {}

    /// The user has chosen the file that was asked for.
    virtual void file_chosen(FileQuestion, const std::filesystem::path&) {}

    /// Another feature shows something beside the model or in its place.
    virtual void give_way() {}

    /// A place is looked at [mm].
    virtual void looked_at(const Vec3&) {}
};

}  // namespace vesselbench
