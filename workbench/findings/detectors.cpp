#include "workbench/findings/detectors.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

const FindingSubject::Lines* FindingSubject::lines(const Progress& progress) {
    if (!searched_) {
        try {
            lines_ = Lines{centerlines_of(surface_, {}, progress), stubs_of(surface_)};
        } catch (const AlgorithmFailure&) {  // a body without vessels
        } catch (const InvalidInput&) {      // one without a lumen
        }
        searched_ = true;
    }
    return lines_ ? &*lines_ : nullptr;
}

const std::vector<WallSpot>& FindingSubject::spots(const Progress& progress) {
    if (!spots_) {
        const Lines* found = lines(progress);
        spots_ = found == nullptr
                     ? std::vector<WallSpot>()
                     : wall_spots(surface_, wall_relief(surface_, *found->graph, progress));
    }
    return *spots_;
}

double FindingSubject::mean_edge() {
    if (!mean_edge_) mean_edge_ = mean_edge_length(surface_);
    return *mean_edge_;
}

std::span<const Detector> detectors() {
#define VESSELBENCH_ROW(name, kind, title, follows) {kind, title, follows, &find_##name},
    static constexpr Detector kTable[] = {VESSELBENCH_DETECTORS(VESSELBENCH_ROW)};
#undef VESSELBENCH_ROW
    return kTable;
}

std::string title_of_kind(const std::string& kind) {
    const auto found = std::ranges::find(detectors(), kind, &Detector::kind);
    return found == detectors().end() ? kind : found->title;
}

}  // namespace vesselbench
