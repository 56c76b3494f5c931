#pragma once

#include <functional>

#include "workbench/window/model/latest_task.h"
#include "workbench/window/model/surface_places.h"

namespace vesselbench {

/// Finds the places of a surface on a thread of its own. Used by the frame's thread; no call blocks
/// but the destructor, which cancels a search and waits for its end.
class PlaceSearch {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit PlaceSearch(std::function<void()> wake);

    /// Begins a search, and forgets the places of the one before.
    /// \param surface null or empty: there are no places
    /// \param tips as for places_of
    void begin(const Surface* surface, bool tips);

    /// Takes a result that is ready. \return true if places() has changed
    bool update();

    [[nodiscard]] bool pending() const { return task_.pending(); }

    [[nodiscard]] const SurfacePlaces& places() const { return places_; }

private:
    LatestTask<SurfacePlaces> task_;
    SurfacePlaces places_;
};

}  // namespace vesselbench
