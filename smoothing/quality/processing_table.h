#pragma once

#include <functional>
#include <map>
#include <memory>

#include "geometry/kernel/surface.h"
#include "smoothing/quality/comparison_meter.h"
#include "smoothing/quality/measure_source.h"

namespace vesselbench {

/// The operation's result for the original and a set; none: a set to leave out. \throw Cancelled
using Processing = std::function<std::optional<Surface>(const ParameterSet&, const Progress&)>;

/// The change that scales graphs.
struct StrongChange {
    ParameterSet set;
    std::string name;  ///< "share=0.05"
};

/// The measures of an operation's results on one surface, with any change of its triangles (thesis
/// 7.2), each found once, sequentially.
class ProcessingTable final : public MeasureSource {
public:
    /// \param idle true for sets that leave the surface as it is
    /// \throw InvalidInput if the original has no area
    ProcessingTable(const Surface& original, Processing processing,
                    std::function<bool(const ParameterSet&)> idle, StrongChange strong);

    void find(std::span<const ParameterSet> sets, const Progress& progress = {}) override;

    [[nodiscard]] std::optional<QualityMeasures> at(const ParameterSet& set,
                                                    const Progress& progress = {}) override;

    [[nodiscard]] bool knows(const ParameterSet& set) const override;

    [[nodiscard]] bool runs_each() const override { return true; }

    [[nodiscard]] const QualityMeasures& original() const override { return meter_.original(); }

    [[nodiscard]] double mean_edge() const override { return meter_.mean_edge(); }

    /// The original's if the strong change is not usable.
    [[nodiscard]] const QualityMeasures& strong(const Progress& progress = {}) override;

    [[nodiscard]] std::string strong_name() const override { return strong_.name; }

    [[nodiscard]] const Work& work() const override { return work_; }

private:
    ComparisonMeter meter_;
    Processing processing_;
    std::function<bool(const ParameterSet&)> idle_;
    StrongChange strong_;
    std::map<ParameterSet, std::optional<QualityMeasures>> known_;
    Work work_;
};

}  // namespace vesselbench
