#include "meshing/products/cfd_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

void require_positive(double value, const char* name, const char* unit) {
    if (std::isfinite(value) && value > 0.0) return;
    throw InvalidInput(std::string("flow conditions: ") + name + " must be above 0 " + unit +
                       ", not " + std::to_string(value));
}

double patch_area(const Surface& surface, std::size_t patch) {
    double area = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if ((*surface.patch_labels)[t] == patch)
            area += triangle_area(surface.points(), surface.triangles()[t]);
    return area;
}

// Length of the edges between a patch and the rest [mm].
double rim_length(const Surface& surface, std::size_t patch) {
    std::map<std::pair<VertexId, VertexId>, int> uses;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        if ((*surface.patch_labels)[t] != patch) continue;
        const Triangle& triangle = surface.triangles()[t];
        for (int k = 0; k < 3; ++k) ++uses[std::minmax(triangle[k], triangle[(k + 1) % 3])];
    }
    double length = 0.0;
    for (const auto& [edge, count] : uses)
        if (count == 1)
            length += (surface.points()[edge.first] - surface.points()[edge.second]).norm();
    return length;
}

/// What an inlet's share of the flow is proportional to.
double weight_of(const InletFlow& inlet, FlowSplit split) {
    // The cube of the diameter of a circle of this area.
    return split == FlowSplit::Cubes ? std::pow(inlet.area, 1.5) : inlet.area;
}

/// The flow of each inlet: as given by name, else by the parameters' split.
void distribute_flow(const CfdParameters& parameters, std::vector<InletFlow>& inlets) {
    const FlowSplit split = parameters.split.value_or(FlowSplit::Area);
    double all = 0.0;
    std::vector<std::string> names;
    for (const InletFlow& inlet : inlets) {
        all += weight_of(inlet, split);
        names.push_back(inlet.name);
    }
    if (parameters.inlet_flows.empty()) {
        for (InletFlow& inlet : inlets)
            inlet.flow = parameters.flow * weight_of(inlet, split) / all;
        return;
    }
    for (const auto& [name, flow] : parameters.inlet_flows) {
        const auto inlet = std::ranges::find(inlets, name, &InletFlow::name);
        if (inlet == inlets.end() || inlet->flow > 0.0)
            throw InvalidInput("flow conditions: inlet_flows has '" + name +
                               (inlet == inlets.end() ? "', which is no inlet; " : "' twice; ") +
                               "the inlets are " + joined(names, ", "));
        require_positive(flow, name.c_str(), "cm^3/s");
        inlet->flow = flow;
    }
    for (const InletFlow& inlet : inlets)
        if (inlet.flow == 0.0)
            throw InvalidInput("flow conditions: inlet_flows lacks the inlet " + inlet.name);
}

/// A patch and what its share of the outflow is proportional to.
struct OutletWeight {
    std::string name;
    double weight = 0.0;
};

/// What the share of an outlet is proportional to.
double outlet_weight(const Patch& outlet, double area, const CfdParameters& parameters) {
    switch (parameters.outlets) {
        case OutletFlow::Cubes:
            return std::pow(area, 1.5);
        case OutletFlow::Bifurcations: {
            const auto share = parameters.outlet_shares.find(outlet.name);
            if (share == parameters.outlet_shares.end())
                throw InvalidInput("flow conditions: outlet_shares lacks the outlet " +
                                   outlet.name);
            return share->second;
        }
        case OutletFlow::Area:
        case OutletFlow::ZeroPressure:
            break;
    }
    return area;
}

std::vector<GivenOutflow> given_outflows(const Surface& surface, const CfdParameters& parameters,
                                         double inflow) {
    if (parameters.outlets == OutletFlow::ZeroPressure ||
        (parameters.outlets == OutletFlow::Bifurcations && parameters.outlet_shares.empty()))
        return {};
    std::vector<OutletWeight> outlets;
    double all = 0.0;
    for (std::size_t k = 0; k < surface.patches.size(); ++k) {
        if (surface.patches[k].kind != PatchKind::Outlet) continue;
        outlets.push_back({surface.patches[k].name,
                           outlet_weight(surface.patches[k], patch_area(surface, k), parameters)});
        all += outlets.back().weight;
    }
    const auto largest = std::ranges::max_element(outlets, {}, &OutletWeight::weight);
    std::vector<GivenOutflow> flows;
    for (auto outlet = outlets.begin(); outlet != outlets.end(); ++outlet)
        if (outlet != largest) flows.push_back({outlet->name, inflow * outlet->weight / all});
    return flows;
}

}  // namespace

double viscosity_at_shear(const CfdParameters& parameters) {
    return parameters.viscosity_model == ViscosityModel::Carreau ? carreau::kAtShear
                                                                 : parameters.viscosity;
}

std::string outlets_text(const CfdParameters& parameters) {
    switch (parameters.outlets) {
        case OutletFlow::Area:
            return "by their areas";
        case OutletFlow::Cubes:
            return "by the cubes of their diameters (Murray's law)";
        case OutletFlow::Bifurcations:
            return "along the centerlines, at each bifurcation by the power" +
                   formatted(parameters.outlet_exponent, " %g") + " of the vessels' diameters";
        case OutletFlow::ZeroPressure:
            break;
    }
    return "";
}

std::string solver_name(bool pulsatile) {
    return pulsatile ? "pimpleFoam" : "simpleFoam";
}

std::string rest_outlet_text() {
    return "the one with the largest share";
}

FlowSummary flow_summary(const Surface& surface, const CfdParameters& parameters,
                         const std::map<std::string, double>& bends) {
    require_positive(parameters.density, "density", "kg/m^3");
    require_positive(parameters.viscosity, "viscosity", "Pa s");
    require_positive(parameters.flow, "flow", "cm^3/s");
    FlowSummary summary;
    for (std::size_t k = 0; k < surface.patches.size(); ++k) {
        if (surface.patches[k].kind == PatchKind::Outlet) ++summary.outlets;
        if (surface.patches[k].kind != PatchKind::Inlet) continue;
        const double area = patch_area(surface, k);
        summary.inlets.push_back({.name = surface.patches[k].name,
                                  .area = area,
                                  .diameter = 4.0 * area / rim_length(surface, k)});
    }
    if (summary.inlets.empty() || summary.outlets == 0)
        throw DiagnosedFailure({.code = "no-inlet-and-outlet",
                                .figures = {{"inlets", static_cast<double>(summary.inlets.size())},
                                            {"outlets", static_cast<double>(summary.outlets)}},
                                .remedies = {{.operation = "clip-opening"}}});
    distribute_flow(parameters, summary.inlets);
    double inflow = 0.0;
    for (const InletFlow& inlet : summary.inlets) inflow += inlet.flow;
    summary.outflows = given_outflows(surface, parameters, inflow);
    for (InletFlow& inlet : summary.inlets) {
        inlet.mean_velocity = inlet.flow / inlet.area;  // cm^3/s by mm^2 is m/s
        inlet.reynolds = inlet.mean_velocity * inlet.diameter * 1e-3 * parameters.density /
                         viscosity_at_shear(parameters);
        if (inlet.reynolds > kLaminarReynolds)
            summary.warnings.push_back({.code = "flow-not-laminar",
                                        .figures = {{"reynolds", inlet.reynolds}},
                                        .words = {{"inlet", inlet.name}}});
        const auto bend = bends.find(inlet.name);
        if (bend != bends.end() && bend->second > kLargestInletBend)
            summary.warnings.push_back({.code = "inlet-in-bend",
                                        .figures = {{"turn_deg", bend->second}},
                                        .words = {{"inlet", inlet.name}}});
    }
    return summary;
}

}  // namespace vesselbench
