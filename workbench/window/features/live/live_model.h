#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "geometry/kernel/deviation_map.h"
#include "workbench/colours/colourings.h"
#include "workbench/operations/smooth/live_smoother.h"
#include "workbench/window/case/answerer.h"

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
    std::string reason = {};  ///< why the CPU has taken over from the device; empty: it has not
};

/// True if a model that is smoothed live can be coloured so.
[[nodiscard]] bool has_live_colours(ColouringKind kind);

using LiveModels = AnswerTask<LiveQuestion, LiveModel>;

/// The device that live models may be computed on.
struct LiveDevice {
    DeviceChoice choice = DeviceChoice::Auto;
    DeviceSource source = offscreen_device;  ///< its context stays with the thread of the models
};

/// Work that computes live models. After the device has failed once, the CPU computes all.
[[nodiscard]] LiveModels::Maker live_modelling(const LiveDevice& device = {});

}  // namespace vesselbench
