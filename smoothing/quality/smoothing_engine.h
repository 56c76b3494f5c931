#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "smoothing/filters/filter_run.h"
#include "smoothing/quality/surface_meter.h"

namespace vesselbench {

/// Weights of a run, #V, as in FilterSettings; null: all 1.
using SharedWeights = std::shared_ptr<const std::vector<double>>;

/// Parameters of staircase awareness covered by a search (thesis 5.3.3, 7.2).
struct StaircaseValues {
    double tau_theta = 0.7, tau_max = 3.0, beta_min = 0.0;
    bool operator==(const StaircaseValues&) const = default;
};

/// Makes staircase weights for other values of their parameters, times all fixed weights. Called
/// from any thread.
using StaircaseWeights =
    std::function<SharedWeights(double tau_theta, double tau_max, double beta_min)>;

/// A filter with all its parameters except the number of iterations.
struct SmoothingChoice {
    /// Staircase weights that an engine makes itself, and a function that makes them if it cannot.
    struct Staircase {
        StaircaseValues values;
        StaircaseWeights on_cpu;
    };

    FilterParameters filter;
    SharedWeights weights;
    std::shared_ptr<const Staircase> staircase = nullptr;  ///< in place of `weights`
};

/// The weights of a choice on the CPU.
[[nodiscard]] SharedWeights weights_of(const SmoothingChoice& choice);

/// Half the diagonal of the bounding box [mm].
[[nodiscard]] double radius_of(const Positions& points);

/// False for measures of a filter that diverges (smoothing/filters/divergence.h): they are not
/// finite, or the mean error exceeds ten times the original's radius.
[[nodiscard]] bool is_bounded(const QualityMeasures& measures, double radius);

/// \throw AlgorithmFailure unless they are bounded
void require_bounded(const QualityMeasures& measures, double radius);

/// A running filter on the engine's surface that can be measured after any iteration. The
/// references of the local error are updated at every 5th iteration, whatever is measured, so a
/// measure depends only on the choice and the iterations.
class MeasuredRun {
public:
    static constexpr int kFollowEvery = 5;

    virtual ~MeasuredRun() = default;

    /// Continues until the given number of iterations is done; never backwards.
    /// \throw Cancelled; the run must not be used afterwards
    virtual void advance_to(int iterations, const Progress& progress) = 0;

    [[nodiscard]] virtual int iterations() const = 0;

    /// \throw AlgorithmFailure if the filter has diverged (is_bounded)
    [[nodiscard]] virtual QualityMeasures measure() = 0;

    /// Continues to each of some ascending iterations and measures there; a device is asked once
    /// for all of them. \return fewer measures if the filter diverges: those before it does
    /// \throw Cancelled; the run must not be used afterwards
    [[nodiscard]] virtual std::vector<QualityMeasures> measure_at(std::span<const int> iterations,
                                                                  const Progress& progress);

    /// Another run in the same state.
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> copy() const = 0;
};

/// A run that updates its references as every MeasuredRun does, wherever they are stored.
class FollowingRun : public MeasuredRun {
public:
    void advance_to(int iterations, const Progress& progress) final {
        while (this->iterations() < iterations) {
            if (due()) follow();
            const int done = this->iterations(), next = (done / kFollowEvery + 1) * kFollowEvery;
            smooth(std::min(next, iterations) - done, progress);
            followed_ = false;
            progress.check_cancelled();
        }
    }

protected:
    [[nodiscard]] bool at_stop() const { return iterations() % kFollowEvery == 0; }

    /// True if the references have not yet passed the stop the run is at.
    [[nodiscard]] bool due() const { return !followed_ && at_stop(); }

    /// Marks them as passed, by a measurement.
    void set_followed() { followed_ = true; }

private:
    virtual void smooth(int iterations, const Progress& progress) = 0;
    virtual void follow() = 0;

    bool followed_ = true;
};

/// Smooths one surface and measures the results: the interface through which searches and
/// sensitivity analysis use the CPU or another device.
class SmoothingEngine {
public:
    virtual ~SmoothingEngine() = default;

    /// \throw InvalidInput as the filter
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> start(
        const SmoothingChoice& choice) const = 0;

    /// True if it makes staircase weights itself, faster than SmoothingChoice::Staircase::on_cpu.
    [[nodiscard]] virtual bool weighs_staircases() const { return false; }

    /// True if start_estimate pays off here.
    [[nodiscard]] virtual bool estimates() const { return false; }

    /// A run that is measured quickly, by a sample, to compare sets.
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> start_estimate(
        const SmoothingChoice& choice) const {
        return start(choice);
    }

    [[nodiscard]] virtual const QualityMeasures& original() const = 0;

    [[nodiscard]] virtual double mean_edge() const = 0;  ///< of the original [mm]

    /// True if runs may proceed in parallel on several threads.
    [[nodiscard]] virtual bool concurrent() const = 0;

    /// Memory of a run [bytes].
    [[nodiscard]] virtual std::size_t run_bytes() const = 0;
};

}  // namespace vesselbench
