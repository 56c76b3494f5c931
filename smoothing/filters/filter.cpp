#include "smoothing/filters/filter.h"

#include "smoothing/filters/divergence.h"

namespace vesselbench {

namespace {

/// The filters' functions under one name.
struct Run {
    const Topology& topology;
    const Positions& positions;
    const FilterSettings& settings;
    const Progress& progress;

    Positions operator()(const LaplaceParameters& p) const {
        return laplace(topology, positions, p, settings, progress);
    }

    Positions operator()(const LaplaceHcParameters& p) const {
        return laplace_hc(topology, positions, p, settings, progress);
    }

    Positions operator()(const TaubinParameters& p) const {
        return taubin(topology, positions, p, settings, progress);
    }

    Positions operator()(const MeanCurvatureFlowParameters& p) const {
        return mean_curvature_flow(topology, positions, p, settings, progress);
    }

    Positions operator()(const AnisotropicParameters& p) const {
        return anisotropic(topology, positions, p, settings, progress);
    }

    Positions operator()(const CurvatureTriggeredParameters& p) const {
        return curvature_triggered(topology, positions, p, settings, progress);
    }
};

}  // namespace

Positions apply_filter(const Topology& topology, const Positions& positions,
                       const FilterParameters& parameters, const FilterSettings& settings,
                       const Progress& progress) {
    Positions result = std::visit(Run{topology, positions, settings, progress}, parameters);
    require_bounded(positions, result);
    return result;
}

}  // namespace vesselbench
