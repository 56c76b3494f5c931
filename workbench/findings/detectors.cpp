#include "workbench/findings/detectors.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

bool FindingSubject::has_lines(const Progress& progress) {
    if (!lines_ && without_lines_.empty()) {
        try {
            lines_ = Lines{centerlines_of(surface_, {}, progress), stubs_of(surface_)};
        } catch (const AlgorithmFailure& failure) {  // a body without vessels
            without_lines_ = failure.what();
        } catch (const InvalidInput& failure) {  // one without a lumen
            without_lines_ = failure.what();
        }
    }
    return lines_.has_value();
}

const FindingSubject::Lines& FindingSubject::lines(const Progress& progress) {
    if (!has_lines(progress)) throw AlgorithmFailure(without_lines_);
    return *lines_;
}

const std::vector<WallSpot>& FindingSubject::spots(const Progress& progress) {
    if (!spots_)
        spots_ = wall_spots(surface_, wall_relief(surface_, *lines(progress).graph, progress));
    return *spots_;
}

std::optional<EndVerdict> FindingSubject::verdict_at(const Vec3& tip, const Progress& progress) {
    if (!tips_) {
        std::optional<ImageBox> image;
        if (scene_.image)
            image = ImageBox{.size = scene_.image->size,
                             .index_to_patient = scene_.image->index_to_patient};
        const Lines& found = lines(progress);
        tips_ = judged_tips(surface_, *found.graph, *found.stubs, image, progress);
    }
    const auto away = [&](const JudgedTip& judged) { return (judged.tip - tip).norm(); };
    const auto nearest = std::ranges::min_element(*tips_, {}, away);
    if (nearest == tips_->end() || away(*nearest) > 0.5 * nearest->verdict.profile.diameter)
        return std::nullopt;
    EndVerdict verdict = nearest->verdict;
    if (const StatedEnd* stated = stated_at(stated_, tip, verdict.profile.diameter))
        verdict.odds = stated->odds;
    return verdict;
}

double FindingSubject::mean_edge() {
    if (!mean_edge_) mean_edge_ = mean_edge_length(surface_);
    return *mean_edge_;
}

std::span<const Detector> detectors() {
#define VESSELBENCH_ROW(name, kind, title, follows, certain) \
    {kind, title, certain, follows, &find_##name},
    static constexpr Detector kTable[] = {VESSELBENCH_DETECTORS(VESSELBENCH_ROW)};
#undef VESSELBENCH_ROW
    return kTable;
}

std::string title_of_kind(const std::string& kind) {
    const auto found = std::ranges::find(detectors(), kind, &Detector::kind);
    return found == detectors().end() ? kind : found->title;
}

std::string certain_of_kind(const std::string& kind) {
    const auto found = std::ranges::find(detectors(), kind, &Detector::kind);
    return found == detectors().end() ? "it is there" : found->certain;
}

}  // namespace vesselbench
