#pragma once

#include <cstdint>
#include <memory>

#include "geometry/kernel/deviation_map.h"
#include "workbench/operations/smooth/live_smoother.h"
#include "workbench/window/model/colourings.h"
#include "workbench/window/model/latest_worker.h"

namespace vesselbench {

/// What a model is to be smoothed with, and which colours are shown.
struct LiveQuestion {
    Scene scene;   ///< that is smoothed
    int base = 0;  ///< its number: equal ones are the same scene
    CheckedArguments arguments;
    ColouringKind colouring = ColouringKind::Patches;
};

/// A model while it is smoothed live, as the view shows it: a value.
struct LiveModel {
    std::uint64_t question = 0;  ///< that it answers
    LiveSmoother::State state;
    /// Distance from the surface before; null: the colours are others, or not known yet.
    std::shared_ptr<const DeviationMap> deviation = nullptr;
    /// Of other colourings. Their range is that of the surface before, so that values can be seen
    /// to change. Null: none, or not known yet.
    std::shared_ptr<const ColourValues> colours = nullptr;
};

/// True if a model that is smoothed live can be coloured so.
[[nodiscard]] bool has_live_colours(ColouringKind kind);

using LiveModels = LatestWorker<LiveQuestion, LiveModel>;

/// Work that computes live models.
/// \param source of the device, whose context stays with the thread
[[nodiscard]] LiveModels::Maker live_modelling(const DeviceSource& source = offscreen_device);

}  // namespace vesselbench
