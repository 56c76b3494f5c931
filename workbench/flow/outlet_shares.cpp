#include "workbench/flow/outlet_shares.h"

#include <algorithm>
#include <limits>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/flow_tree.h"

namespace vesselbench {

namespace {

/// The tip of the lines in an opening, which ends at its centre.
std::size_t tip_in(const CenterlineGraph& graph, const PatchMeasures& opening) {
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const double distance = (graph.nodes[n].position - opening.centroid).norm();
        if (!graph.nodes[n].is_tip() || !(distance < nearest)) continue;
        nearest = distance;
        best = n;
    }
    return best;
}

void require_lines_to_all(const std::map<std::string, double>& shares) {
    for (const auto& [outlet, share] : shares)
        if (!(share > 0.0))
            throw DiagnosedFailure({.code = "outlet-without-line", .words = {{"outlet", outlet}}});
}

}  // namespace

CfdParameters with_outlet_shares(CfdParameters flow, const Surface& surface,
                                 const Progress& progress) {
    if (flow.outlets != OutletFlow::Bifurcations || !flow.outlet_shares.empty()) return flow;
    const FlowSummary inflow = flow_summary(surface, flow);
    const auto graph = centerlines_of(surface, {}, progress);
    const std::vector<PatchMeasures> patches = measure_patches(surface);
    std::vector<std::string> names;
    std::vector<std::size_t> outlets;
    for (const PatchMeasures& patch : patches) {
        if (patch.kind != PatchKind::Outlet) continue;
        names.push_back(patch.name);
        outlets.push_back(tip_in(*graph, patch));
    }
    double all = 0.0;
    for (const InletFlow& inlet : inflow.inlets) all += inlet.flow;
    for (const InletFlow& inlet : inflow.inlets) {
        const auto patch = std::ranges::find(patches, inlet.name, &PatchMeasures::name);
        const std::vector<double> shares =
            shares_of_outlets(*graph, tip_in(*graph, *patch), outlets, flow.outlet_exponent);
        for (std::size_t k = 0; k < names.size(); ++k)
            flow.outlet_shares[names[k]] += shares[k] * inlet.flow / all;
    }
    require_lines_to_all(flow.outlet_shares);
    return flow;
}

}  // namespace vesselbench
