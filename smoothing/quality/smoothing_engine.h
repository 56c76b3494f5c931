#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/kernel/progress.h"
#include "smoothing/filters/filter_run.h"
#include "smoothing/quality/surface_meter.h"

namespace vesselbench {

/// Weights of a run, #V, as in FilterSettings; null: all 1.
using SharedWeights = std::shared_ptr<const std::vector<double>>;

/// Parameters of staircase awareness that a search changes (thesis 5.3.3, 7.2).
struct StaircaseValues {
    double tau_theta = 0.7, tau_max = 3.0, beta_min = 0.0;
    bool operator==(const StaircaseValues&) const = default;
};

/// Makes weights of staircase awareness for other values of its parameters, times all weights that
/// stay. Called from any thread.
using StaircaseWeights =
    std::function<SharedWeights(double tau_theta, double tau_max, double beta_min)>;

/// A filter with all its parameters but the number of iterations.
struct SmoothingChoice {
    /// Staircase weights that an engine makes itself, and what makes them if it cannot.
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

/// A run that follows its references as every MeasuredRun does, whatever they are kept in.
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

    /// True if the references have not passed the stop that the run stands at.
    [[nodiscard]] bool due() const { return !followed_ && at_stop(); }

    /// They have, by a measure.
    void set_followed() { followed_ = true; }

private:
    virtual void smooth(int iterations, const Progress& progress) = 0;
    virtual void follow() = 0;

    bool followed_ = true;
};

/// What smooths one surface and measures the results: the door through which searches and
/// sensitivity analysis use the CPU, or another device.
class SmoothingEngine {
public:
    virtual ~SmoothingEngine() = default;

    /// \throw InvalidInput as the filter
    [[nodiscard]] virtual std::unique_ptr<MeasuredRun> start(
        const SmoothingChoice& choice) const = 0;

    /// True if it makes staircase weights itself, faster than SmoothingChoice::Staircase::on_cpu.
    [[nodiscard]] virtual bool weighs_staircases() const { return false; }

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

}  // namespace vesselbench
