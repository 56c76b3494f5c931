#include "workbench/flow/outlet_shares.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "workbench/case/measure_json.h"

namespace vesselbench {

namespace {

[[noreturn]] void refuse(const PatchMeasures& opening) {
    throw DiagnosedFailure({.code = "outlet-without-line",
                            .place = opening.centroid,
                            .words = {{"opening", opening.name}}});
}

/// The openings with the tips of the lines in them.
class OpeningTips {
public:
    explicit OpeningTips(const CenterlineGraph& graph) : graph_(graph) {}

    /// The tip in an opening. \throw DiagnosedFailure if there is none, or another opening has it
    std::size_t take(const PatchMeasures& opening) {
        const std::optional<std::size_t> tip = nearest_tip(graph_, opening.centroid);
        const double reach = 0.5 * diameter_of_area(opening.area);
        if (!tip || (graph_.nodes[*tip].position - opening.centroid).norm() > reach ||
            !taken_.insert(*tip).second)
            refuse(opening);
        return *tip;
    }

private:
    const CenterlineGraph& graph_;
    std::set<std::size_t> taken_;
};

struct FedInlet {
    std::size_t tip = 0;
    double flow = 0.0;  ///< [cm^3/s]
};

}  // namespace

CfdParameters shared_along(const CenterlineGraph& lines, CfdParameters flow,
                           const Surface& surface) {
    flow.outlet_shares.clear();
    const FlowSummary inflow = flow_summary(surface, flow);
    OpeningTips tips(lines);
    std::vector<FedInlet> inlets;
    std::vector<PatchMeasures> outlets;
    std::vector<std::size_t> outlet_tips;
    double all = 0.0;
    for (const PatchMeasures& patch : measure_patches(surface)) {
        if (patch.kind == PatchKind::Inlet) {
            const auto fed = std::ranges::find(inflow.inlets, patch.name, &InletFlow::name);
            inlets.push_back({tips.take(patch), fed->flow});
            all += fed->flow;
        } else if (patch.kind == PatchKind::Outlet) {
            outlets.push_back(patch);
            outlet_tips.push_back(tips.take(patch));
        }
    }
    for (const FedInlet& inlet : inlets) {
        const std::vector<double> shares =
            shares_of_outlets(lines, inlet.tip, outlet_tips, flow.outlet_exponent);
        for (std::size_t k = 0; k < outlets.size(); ++k)
            flow.outlet_shares[outlets[k].name] += shares[k] * inlet.flow / all;
    }
    for (const PatchMeasures& outlet : outlets)
        if (!(flow.outlet_shares.at(outlet.name) > 0.0)) refuse(outlet);
    return flow;
}

CfdParameters with_outlet_shares(CfdParameters flow, const Surface& surface,
                                 const Progress& progress) {
    if (flow.outlets != OutletFlow::Bifurcations || !flow.outlet_shares.empty()) return flow;
    static_cast<void>(flow_summary(surface, flow));  // refuses before the lines are looked for
    return shared_along(*centerlines_of(surface, {}, progress), std::move(flow), surface);
}

CfdParameters with_outlet_shares(CfdParameters flow, const VolumeMesh& mesh,
                                 const Progress& progress) {
    if (flow.outlets != OutletFlow::Bifurcations || !flow.outlet_shares.empty()) return flow;
    return with_outlet_shares(std::move(flow), boundary_surface(mesh), progress);
}

}  // namespace vesselbench
