#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quality/smoothing_engine.h"

namespace vesselbench {

/// How runs are measured.
enum class Fidelity {
    Full,     ///< as SmoothingEngine::start
    Estimate  ///< as SmoothingEngine::start_estimate
};

/// Values of all parameters of a search; the last one is the number of iterations.
using ParameterSet = std::vector<double>;

/// Makes the filter of a parameter set, whose iterations do not count; none: a set to leave out, as
/// the filter would roughen the surface. Called by one thread at a time.
using Chooser = std::function<std::optional<SmoothingChoice>(std::span<const double> values)>;

/// The measures of parameter sets on one surface, each found once. Sets that differ in iterations
/// only share a run, which goes through all of them; where it goes on later from is kept as far as
/// memory allows. Different runs go on at the same time. For one thread at a time.
class QualityTable {
public:
    /// \param kept_bytes of runs to go on from [bytes]
    QualityTable(std::shared_ptr<const SmoothingEngine> engine, Chooser chooser,
                 std::size_t kept_bytes = std::size_t{256} << 20,
                 Fidelity fidelity = Fidelity::Full);

    /// Finds what is not known yet. If it is interrupted, what was found by then stays known.
    /// \throw Cancelled
    void find(std::span<const ParameterSet> sets, const Progress& progress = {});

    /// None where the set is left out. \throw as find
    [[nodiscard]] std::optional<QualityMeasures> at(const ParameterSet& set,
                                                    const Progress& progress = {});

    /// What a very strong smoothing gives, 50 iterations of Laplace with lambda 1 (6.5.3).
    [[nodiscard]] const QualityMeasures& strong(const Progress& progress = {});

    [[nodiscard]] const SmoothingEngine& engine() const { return *engine_; }

    /// What was done so far.
    struct Work {
        std::size_t evaluations = 0;  ///< measurements of smoothed surfaces
        std::size_t runs = 0;         ///< filters started from the original surface
        std::size_t sweeps = 0;       ///< iterations over the surface
    };

    [[nodiscard]] const Work& work() const { return work_; }

private:
    /// All sets that differ in iterations only.
    struct Column {
        std::optional<SmoothingChoice> choice;
        std::map<int, QualityMeasures> known;                  ///< by iterations
        std::map<int, std::unique_ptr<MeasuredRun>> standing;  ///< runs to go on from
    };

    struct Task {
        Column* column = nullptr;
        std::vector<int> wanted;  ///< iterations, ascending
        Work work;
    };

    Column& column_of(const ParameterSet& set);
    std::vector<Task> tasks_for(std::span<const ParameterSet> sets);
    void run(Task& task, std::size_t may_stand, const Progress& progress) const;

    std::shared_ptr<const SmoothingEngine> engine_;
    Chooser chooser_;
    std::size_t most_standing_ = 0;
    Fidelity fidelity_ = Fidelity::Full;
    std::map<ParameterSet, Column> columns_;
    std::optional<QualityMeasures> strong_;
    Work work_;
};

}  // namespace vesselbench
