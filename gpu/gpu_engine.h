#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device_choice.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "smoothing/quality/smoothing_engine.h"

namespace vesselbench {

/// The inputs of staircase weights that do not depend on thresholds.
struct StaircaseGround {
    StackAxes stack_axes = Vec3::UnitZ();
    std::vector<std::uint8_t> caps;  ///< as in StaircaseParameters
    StaircaseScaling scaling = StaircaseScaling::TauMax;
    SharedWeights others;  ///< multiplied with them
};

/// The engine of GpuSmoother and GpuMeter on a device; single precision. The engine and its runs
/// must be used and destroyed on the thread where the device is current; a second one on another
/// thread needs its own context.
/// \param planes measures error_thesis too
/// \param staircases for the ground's start: the device then computes the weights of
/// SmoothingChoice::staircase; without it the choice's own function does
/// \throw InvalidInput if the ground is inconsistent; GpuUnavailable if it does not fit the device.
/// Runs throw GpuUnavailable if the context is lost.
[[nodiscard]] std::shared_ptr<const SmoothingEngine> make_gpu_engine(
    HeldDevice device, const FilterGround& ground, bool planes = false,
    std::optional<StaircaseGround> staircases = std::nullopt);

/// The engine selected by a choice.
struct ChosenEngine {
    std::shared_ptr<const SmoothingEngine> engine;
    bool on_gpu = false;
    std::string device_name;  ///< the driver's name; empty on the CPU
    std::string reason;       ///< why it falls back to the CPU; else empty
};

/// The GPU's engine or the CPU's. If the device fails midway, the CPU takes over: runs continue
/// from their state, and later ones start on the CPU.
/// \throw InvalidInput if the ground is inconsistent
[[nodiscard]] ChosenEngine make_engine(DeviceChoice choice, const FilterGround& ground,
                                       bool planes = false,
                                       const DeviceSource& source = offscreen_device,
                                       std::optional<StaircaseGround> staircases = std::nullopt);

}  // namespace vesselbench
