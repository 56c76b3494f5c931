#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/device_choice.h"
#include "smoothing/filters/filter_run.h"
#include "workbench/case/operation.h"
#include "workbench/operations/smooth/change_meter.h"
#include "workbench/operations/smooth/context.h"

namespace vesselbench {

/// What `smooth` makes of a scene, found again and again while its arguments change (thesis 6.3.5).
/// What the changed arguments do not concern is kept: caps, staircases, weights, distances, and the
/// iterations done so far. Not thread-safe; with a device, all calls belong to its thread.
class LiveSmoother {
public:
    /// \param device to compute on, current on this thread; none: the CPU
    explicit LiveSmoother(Scene scene, std::optional<HeldDevice> device = {});
    ~LiveSmoother();
    LiveSmoother(const LiveSmoother&) = delete;
    LiveSmoother& operator=(const LiveSmoother&) = delete;

    struct State {
        Surface surface;
        Arguments resolved;                                  ///< with all decisions
        std::shared_ptr<const std::vector<double>> weights;  ///< #V; null: 1 everywhere
        int iterations = 0;                          ///< done so far; all of them if it is `whole`
        bool whole = false;                          ///< all iterations are done
        bool exact = false;                          ///< `smooth` gives the same bits
        std::optional<SmoothingChange> change = {};  ///< none: not measured yet
        std::string device = "cpu";                  ///< "cpu" or "gpu"
    };

    using Receiver = std::function<void(const State&)>;

    /// Sends the surface after all iterations, then with its figures if measuring takes too long to
    /// wait for. While iterations take long, it sends what is done so far, ten times a second.
    /// \param given with defaults
    /// \return the last state sent
    /// \throw as the operation; Cancelled. Earlier findings are kept
    State run(const CheckedArguments& given, const Receiver& receive, const Progress& progress);

    /// A state of run() as the operation itself leaves it: computed by the CPU, and taken back
    /// where the surface would pass through itself. \throw as run()
    [[nodiscard]] State exact(State state, const Progress& progress);

    /// Why the CPU has taken over from the device; empty: it has not.
    [[nodiscard]] const std::string& reason() const { return reason_; }

private:
    struct Found;
    struct OnDevice;

    void find_context(Arguments& arguments);
    void prepare_ground(const Arguments& arguments);
    [[nodiscard]] State begun(const CheckedArguments& given);
    [[nodiscard]] bool smooth_on_device(State& state, const Progress& progress);
    void smooth_on_cpu(State& state, const Receiver& receive, const Progress& progress);
    [[nodiscard]] FilterRun& run_to_continue(const Arguments& resolved, int iterations);
    void advance(int iterations);
    void take_positions(State& state);
    void measure(State& state);
    void measure_exactly(State& state);

    Scene scene_;
    std::string reason_;
    std::unique_ptr<OnDevice> device_;
    std::unique_ptr<ContextFinder> finder_;
    std::shared_ptr<const Found> found_;  ///< the last context
    Arguments pinned_;                    ///< what staircases were decided by
    std::shared_ptr<const FilterRun::Ground> ground_;
    std::shared_ptr<const Found> ground_of_;  ///< the context it was prepared in
    Arguments run_arguments_;                 ///< of the filter of run_
    std::shared_ptr<const Found> run_of_;
    std::unique_ptr<FilterRun> run_;  ///< the last one, to be continued
    DerivedCache no_cache_{0};        ///< states would displace what is needed again
    std::optional<QuickChangeMeter> meter_;
    std::optional<ChangeMeter> exact_meter_;
    int portion_ = 1;               ///< iterations between two looks at the clock
    double measure_seconds_ = 0.0;  ///< of the last measurement
};

}  // namespace vesselbench
