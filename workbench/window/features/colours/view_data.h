#pragma once

#include <functional>
#include <memory>
#include <string>

#include "geometry/vessel/centerlines/centerline_graph.h"
#include "workbench/colours/colourings.h"
#include "workbench/session/task.h"
#include "workbench/window/case/document.h"
#include "workbench/window/drawing/view_choice.h"

namespace vesselbench {

/// What the view shows of the shown scene besides its surface: found on threads, and only when it
/// is chosen. Used by the frame's thread.
class ViewData {
public:
    /// \param wake called by other threads when update() has something to do
    explicit ViewData(const std::function<void()>& wake);

    /// Once a frame: begins searches for what is chosen, takes what is ready.
    /// \return true if something has changed
    bool update(const Document& document, const ViewChoice& view, const ShownLayers& layers);

    /// Null while there are none, and for patches and deviation.
    [[nodiscard]] const std::shared_ptr<const ColourValues>& colours() const {
        return colours_.newest();
    }

    /// Why there are no colours; empty: no problem.
    [[nodiscard]] const std::string& colours_problem() const { return colours_.problem(); }

    /// Null while they are not known or not needed.
    [[nodiscard]] const std::shared_ptr<const CenterlineGraph>& centerlines() const;

    [[nodiscard]] const std::string& centerlines_problem() const { return lines_.problem(); }

    [[nodiscard]] bool finds_colours() const { return colours_.pending(); }

    [[nodiscard]] bool finds_centerlines() const { return lines_.pending(); }

    [[nodiscard]] bool pending() const { return finds_colours() || finds_centerlines(); }

private:
    /// What a search was begun for.
    struct Asked {
        int scene = -1;  ///< the document's scene changes; -1: nothing
        ColouringKind kind = ColouringKind::Patches;

        bool operator==(const Asked&) const = default;
    };

    void ask_colours(const Document& document, Asked now);
    void ask_lines(const Document& document, Asked now);

    using Lines = std::shared_ptr<const CenterlineGraph>;

    Task<ColourValues> colours_;
    Task<Lines> lines_;
    Asked asked_colours_, asked_lines_;
};

}  // namespace vesselbench
