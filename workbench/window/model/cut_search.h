#pragma once

#include <functional>
#include <optional>

#include "geometry/vessel/openings/planned_cut.h"
#include "workbench/window/model/latest_task.h"

namespace vesselbench {

/// Finds cuts on a thread of its own while a plane is dragged.
class CutSearch {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit CutSearch(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame: begins a search if the question or the surface is another one, and takes a
    /// result. The last cut of the same branch stays until the next one is known.
    /// \param surface null: there is nothing to cut
    void update(const Surface* surface, const std::optional<CutQuestion>& question);

    [[nodiscard]] const std::optional<Cut>& cut() const { return cut_; }

    [[nodiscard]] bool pending() const { return task_.pending(); }

private:
    std::optional<CutQuestion> asked_;
    Surface surface_;  ///< of the question
    std::optional<Cut> cut_;
    LatestTask<Cut> task_;
};

}  // namespace vesselbench
