#include "smoothing/quality/processing_table.h"

#include <utility>

namespace vesselbench {

ProcessingTable::ProcessingTable(const Surface& original, Processing processing,
                                 std::function<bool(const ParameterSet&)> idle, StrongChange strong)
    : meter_(original),
      processing_(std::move(processing)),
      idle_(std::move(idle)),
      strong_(std::move(strong)) {}

void ProcessingTable::find(std::span<const ParameterSet> sets, const Progress& progress) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
        progress.check_cancelled();
        if (known_.contains(sets[i])) continue;
        if (idle_(sets[i])) {
            known_[sets[i]] = meter_.original();
            continue;
        }
        const auto count = static_cast<double>(sets.size());
        progress.report(static_cast<double>(i) / count, "measuring");
        const auto surface = processing_(sets[i], progress.silent());
        ++work_.runs;
        if (surface) ++work_.evaluations;
        std::optional<QualityMeasures> measures;
        if (surface) measures = meter_.measure(*surface, progress);  // may be cancelled
        known_.emplace(sets[i], measures);
    }
}

bool ProcessingTable::knows(const ParameterSet& set) const {
    return known_.contains(set);
}

std::optional<QualityMeasures> ProcessingTable::at(const ParameterSet& set,
                                                   const Progress& progress) {
    find({&set, 1}, progress);
    return known_.at(set);
}

const QualityMeasures& ProcessingTable::strong(const Progress& progress) {
    find({&strong_.set, 1}, progress);
    const auto& found = known_.at(strong_.set);
    return found ? *found : original();
}

}  // namespace vesselbench
