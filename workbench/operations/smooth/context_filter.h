#pragma once

#include <memory>
#include <string>

#include "gpu/device_choice.h"
#include "smoothing/context/context_finder.h"
#include "workbench/case/operation.h"
#include "workbench/operations/smooth/context.h"

namespace vesselbench {

/// Finds the context of a scene's surface and filters the surface in it, once or repeatedly with
/// other arguments: the context is found again only if its own arguments change. The CPU's result
/// is committed unless the argument `device` asks for the GPU (DESIGN 1); then both run there, and
/// both on the CPU if the device fails, now or midway. Not thread-safe.
class ContextFilter {
public:
    explicit ContextFilter(Scene scene, DeviceSource source = offscreen_device);
    ~ContextFilter();

    struct Result {
        Positions positions;  ///< [mm], #V
        Arguments resolved;   ///< with the context's decisions, and the device used
        SmoothingFigures figures = {};
        std::string reason = {};  ///< why the CPU was used although the GPU was asked for, or empty
        std::string device = {};  ///< that was used, as Outcome::device
    };

    /// \param arguments of `smooth` after resolve_filter
    /// \throw as smoothing_context and the filter; Cancelled. Earlier findings are kept
    [[nodiscard]] Result run(const Arguments& arguments, const Progress& progress);

private:
    struct Found;

    [[nodiscard]] Result on_cpu(const Arguments& arguments, const Progress& progress);
    [[nodiscard]] Result on_device(const Device& device, const Arguments& arguments,
                                   const Progress& progress);
    [[nodiscard]] bool is_found(const Arguments& arguments, bool on_gpu) const;

    Scene scene_;
    DeviceSource source_;
    std::unique_ptr<ContextFinder> cpu_;  ///< keeps the caps found
    std::shared_ptr<const Found> found_;  ///< last
};

}  // namespace vesselbench
