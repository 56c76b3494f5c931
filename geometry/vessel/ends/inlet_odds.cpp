#include "geometry/vessel/ends/inlet_odds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/kernel/statistics.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "geometry/vessel/ends/weight_table.h"

namespace vesselbench {

namespace {

/// Less likely an opening, it is no inlet [-].
constexpr double kLeastOpening = 0.5;
/// Vessels of this diameter [mm] divide those of the head, where the blood flows upwards, from
/// those of the trunk.
constexpr double kWideVessel = 8.0;

/// The lines' diameters where blood flows: branches that end in a sac or a bump have none, and
/// those of ends are at least as wide as what closes them allows: a short one has no course.
std::vector<double> flowing(const CenterlineGraph& graph, const std::vector<SurfaceEnd>& ends,
                            const std::vector<EndProfile>& profiles,
                            const std::vector<double>& opening) {
    std::vector<double> diameters = course_diameters(graph);
    for (std::size_t e = 0; e < ends.size(); ++e) {
        if (!ends[e].tip) continue;
        double& diameter = diameters[branch_of_tip(graph, *ends[e].tip)];
        diameter = opening[e] < kLeastOpening ? 0.0 : std::max(diameter, profiles[e].diameter);
    }
    return diameters;
}

/// The same by the widths next to the furcations: an end may be dilated, or cut in a narrowing.
std::vector<double> flowing_inside(std::vector<double> flowing, const CenterlineGraph& graph,
                                   const std::vector<SurfaceEnd>& ends,
                                   const std::vector<EndProfile>& profiles) {
    for (std::size_t e = 0; e < ends.size(); ++e) {
        if (!ends[e].tip) continue;
        double& diameter = flowing[branch_of_tip(graph, *ends[e].tip)];
        if (diameter > 0.0) diameter = profiles[e].inner;
    }
    return flowing;
}

/// A trunk may end in a spike, or its course lead through a bend that is narrower than its end.
/// Both ends of a vessel without furcations have its course in common.
double width_of(const SurfaceEnd& end, const EndProfile& profile) {
    if (!end.tip) return profile.diameter;  // a torn rim is longer than it is wide
    return profile.parent > 0.0 ? std::max(profile.diameter, end.diameter) : end.diameter;
}

/// Of its rim or cap, where it has one [mm].
double closure_of(const SurfaceEnd& end, const EndProfile& profile) {
    return profile.closure > 0.0 ? profile.closure : width_of(end, profile);
}

class Candidates {
public:
    Candidates(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
               const std::vector<EndProfile>& profiles, const std::vector<double>& opening)
        : ends_(ends),
          profiles_(profiles),
          opening_(opening),
          tree_(scene.graph, flowing(scene.graph, ends, profiles, opening)),
          inside_(scene.graph, flowing_inside(flowing(scene.graph, ends, profiles, opening),
                                              scene.graph, ends, profiles)) {
        for (std::size_t e = 0; e < ends.size(); ++e) {
            if (opening[e] < kLeastOpening) continue;
            open_.push_back(e);
            widest_ = std::max(widest_, width_of(ends[e], profiles[e]));
            closure_ = std::max(closure_, closure_of(ends[e], profiles[e]));
            course_ = std::max(course_, profiles[e].diameter);
            inner_ = std::max(inner_, profiles[e].inner);
            middle_ += ends[e].centre;
        }
        middle_ /= static_cast<double>(std::max<std::size_t>(1, open_.size()));
        for (const std::size_t e : open_)
            reach_ = std::max(reach_, (ends[e].centre - middle_).norm());
        set_roots();
    }

    [[nodiscard]] const std::vector<std::size_t>& open() const { return open_; }

    [[nodiscard]] InletFeatures features(std::size_t e) const {
        const SurfaceEnd& end = ends_[e];
        const double width = width_of(end, profiles_[e]);
        double others = 0.0;
        for (const std::size_t other : open_)
            if (other != e) others += std::log(width / width_of(ends_[other], profiles_[other]));
        if (open_.size() > 1) others /= static_cast<double>(open_.size() - 1);
        const double height = reach_ > 0.0 ? (end.centre - middle_).z() / reach_ : 0.0;
        const double size = std::clamp(std::log(widest_ / kWideVessel), -1.0, 1.0);
        const Root& root = roots_.at(e);
        return {root.whole.murray,
                root.whole.turn,
                std::log(width / widest_),
                std::log(closure_of(end, profiles_[e]) / closure_),
                std::log(std::max(profiles_[e].diameter, 1e-6) / course_),
                others,
                std::log(std::max(profiles_[e].length, 0.1 * width) / width),
                height,
                size > 0.0 ? height : 0.0,
                height * size,
                std::log(opening_[e] / (1.0 - opening_[e] + 1e-6)),
                std::log(std::max(profiles_[e].inner, 1e-6) / inner_),
                root.inside_murray,
                std::log(closure_of(end, profiles_[e]) / std::max(profiles_[e].inner, 1e-6))};
    }

private:
    struct Root {
        RootFigures whole;
        double inside_murray = 0.0;
    };

    /// An end in a vessel's side, to which no line leads, is as little a root as the worst one.
    void set_roots() {
        Root worst;
        for (const std::size_t e : open_) {
            if (!ends_[e].tip) continue;
            const Root root{tree_.figures(*ends_[e].tip), inside_.figures(*ends_[e].tip).murray};
            worst.whole.murray = std::max(worst.whole.murray, root.whole.murray);
            worst.whole.turn = std::max(worst.whole.turn, root.whole.turn);
            worst.inside_murray = std::max(worst.inside_murray, root.inside_murray);
            roots_[e] = root;
        }
        for (const std::size_t e : open_) roots_.try_emplace(e, worst);
    }

    const std::vector<SurfaceEnd>& ends_;
    const std::vector<EndProfile>& profiles_;
    const std::vector<double>& opening_;
    FlowTree tree_, inside_;
    std::map<std::size_t, Root> roots_;  ///< by end that is open
    std::vector<std::size_t> open_;
    double widest_ = 0.0, closure_ = 0.0, course_ = 1e-6, inner_ = 1e-6, reach_ = 0.0;
    Vec3 middle_ = Vec3::Zero();
};

}  // namespace

std::vector<InletCandidate> inlet_candidates(const EndScene& scene,
                                             const std::vector<SurfaceEnd>& ends,
                                             const std::vector<EndProfile>& profiles,
                                             const std::vector<double>& opening,
                                             const Progress& progress) {
    static const auto weights = weights_from<1>("inlet_weights.csv", kInletFeatures);
    const Candidates candidates(scene, ends, profiles, opening);
    std::vector<InletCandidate> found;
    double most = -std::numeric_limits<double>::infinity();
    for (const std::size_t e : candidates.open()) {
        progress.check_cancelled();
        InletCandidate& candidate = found.emplace_back();
        candidate.end = e;
        candidate.width = width_of(ends[e], profiles[e]);
        candidate.features = candidates.features(e);
        for (std::size_t f = 0; f < weights.size(); ++f)
            candidate.odds += weights[f][0] * candidate.features[f];
        most = std::max(most, candidate.odds);
    }
    double sum = 0.0;
    for (InletCandidate& candidate : found) sum += candidate.odds = std::exp(candidate.odds - most);
    for (InletCandidate& candidate : found) candidate.odds /= sum;
    std::ranges::stable_sort(found, std::greater{}, &InletCandidate::odds);
    return found;
}

}  // namespace vesselbench
