#pragma once

#include <memory>
#include <vector>

#include "geometry/progress.h"
#include "quality/surface_meter.h"
#include "smoothing/filter_run.h"

namespace vesselbench {

/// A filter with all its parameters but the number of iterations.
struct SmoothingChoice {
    FilterParameters filter;
    std::shared_ptr<const std::vector<double>> weights;  ///< #V, as in FilterSettings; null: all 1
};

/// A filter on its way over the engine's surface, which can be measured after any iteration. The
/// references of the local error are followed at every 5th iteration, whatever is measured: so a
/// measure depends on the choice and the iterations only.
class MeasuredRun {
public:
    static constexpr int kFollowEvery = 5;

    virtual ~MeasuredRun() = default;

    /// Goes on until so many iterations are done; not back.
    /// \throw Cancelled; the run is of no use then
    virtual void advance_to(int iterations, const Progress& progress) = 0;

    [[nodiscard]] virtual int iterations() const = 0;

    [[nodiscard]] virtual QualityMeasures measure() = 0;

    /// Another run that stands where this one does.
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> copy() const = 0;
};

/// What smooths one surface and measures the results: the door through which searches and
/// sensitivity analysis use the CPU, or another device.
class SmoothingEngine {
public:
    virtual ~SmoothingEngine() = default;

    /// \throw InvalidInput as the filter
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> start(
        const SmoothingChoice& choice) const = 0;

    /// True if start_estimate is worth it here.
    [[nodiscard]] virtual bool estimates() const { return false; }

    /// A run that is measured quickly, by a sample, to tell sets apart.
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> start_estimate(
        const SmoothingChoice& choice) const {
        return start(choice);
    }

    [[nodiscard]] virtual const QualityMeasures& original() const = 0;

    [[nodiscard]] virtual double mean_edge() const = 0;  ///< of the original [mm]

    /// True if runs may go on at the same time on several threads.
    [[nodiscard]] virtual bool concurrent() const = 0;

    /// Memory that a run takes [bytes].
    [[nodiscard]] virtual std::size_t run_bytes() const = 0;
};

/// The engine of smoothing/ and SurfaceMeter. The same bits on any number of threads.
/// \param planes measures error_thesis too
/// \throw InvalidInput if the ground does not fit together
[[nodiscard]] std::shared_ptr<const SmoothingEngine> make_cpu_engine(FilterGround ground,
                                                                     bool planes = false);

}  // namespace vesselbench
