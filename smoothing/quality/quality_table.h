#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "smoothing/quality/measure_source.h"
#include "smoothing/quality/smoothing_engine.h"

namespace vesselbench {

/// How runs are measured.
enum class Fidelity {
    Full,     ///< as SmoothingEngine::start
    Estimate  ///< as SmoothingEngine::start_estimate
};

/// Makes the filter of a parameter set, ignoring its iterations; none: a set to leave out, because
/// the filter would roughen the surface. Called by one thread at a time.
using Chooser = std::function<std::optional<SmoothingChoice>(std::span<const double> values)>;

/// The measures of smoothing, each found once; the last parameter is the number of iterations. Sets
/// that differ only in iterations share a run through all of them; runs that may be continued later
/// are kept as far as memory allows. Sets whose filter diverges are left out. Different runs
/// proceed in parallel.
class QualityTable final : public MeasureSource {
public:
    /// \param kept_bytes of runs to be continued [bytes]
    QualityTable(std::shared_ptr<const SmoothingEngine> engine, Chooser chooser,
                 std::size_t kept_bytes = std::size_t{256} << 20,
                 Fidelity fidelity = Fidelity::Full);

    void find(std::span<const ParameterSet> sets, const Progress& progress = {}) override;

    [[nodiscard]] std::optional<QualityMeasures> at(const ParameterSet& set,
                                                    const Progress& progress = {}) override;

    [[nodiscard]] bool knows(const ParameterSet& set) const override;

    [[nodiscard]] bool runs_each() const override { return false; }

    [[nodiscard]] const QualityMeasures& original() const override { return engine_->original(); }

    [[nodiscard]] double mean_edge() const override { return engine_->mean_edge(); }

    /// 50 iterations of Laplace with lambda 1 (6.5.3).
    [[nodiscard]] const QualityMeasures& strong(const Progress& progress = {}) override;

    [[nodiscard]] std::string strong_name() const override;

    [[nodiscard]] const Work& work() const override { return work_; }

private:
    /// All sets that differ only in iterations.
    struct Column {
        std::optional<SmoothingChoice> choice;
        std::map<int, std::optional<QualityMeasures>> known;   ///< by iterations; none: diverged
        std::map<int, std::unique_ptr<MeasuredRun>> standing;  ///< runs to be continued
    };

    struct Task {
        Column* column = nullptr;
        std::vector<int> wanted;  ///< iterations, ascending
        Work work;
    };

    Column& column_of(const ParameterSet& set);
    std::vector<Task> tasks_for(std::span<const ParameterSet> sets);
    [[nodiscard]] std::unique_ptr<MeasuredRun> run_before(Task& task) const;
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
