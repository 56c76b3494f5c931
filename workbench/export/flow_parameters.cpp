#include "workbench/export/flow_parameters.h"

#include <algorithm>
#include <sstream>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/checked_value.h"

namespace vesselbench {

namespace {

using enum ParameterType;

std::vector<Parameter> boundary_parameters() {
    const CfdParameters d;
    return {
        {.name = "flow",
         .unit = "cm^3/s",
         .default_value = d.flow,
         .help = "total inflow of blood through all inlets; split among them",
         .minimum = 0.0,
         .above_minimum = true},
        {.name = "split",
         .type = Choice,
         .help = "how several inlets share it: by their areas, or by the cubes of their "
                 "diameters (Murray); default: area, of a vein cubes",
         .choices = {"area", "cubes"}},
        {.name = "inlet_flows",
         .type = Text,
         .help = "flow of each inlet [cm^3/s] in place of it: inlet_1:2.5,inlet_2:1.8"},
        {.name = "outlets",
         .type = Choice,
         .default_value = "zero-pressure",
         .help =
             std::string(
                 "what leaves through the outlets: what one pressure at all of them gives, or "
                 "shares by their areas, by the cubes of their diameters (Murray), or along the "
                 "centerlines, bifurcation by bifurcation; the rest through ") +
             rest_outlet_text(),
         .choices = {"zero-pressure", "area", "cubes", "bifurcations"}},
        {.name = "outlet_exponent",
         .unit = "-",
         .default_value = d.outlet_exponent,
         .help = "of outlets=bifurcations: the vessels behind a bifurcation share by this power "
                 "of their diameters; 3: Murray",
         .minimum = 0.0,
         .maximum = 6.0,
         .only_with = Condition{"outlets", {"bifurcations"}}},
        {.name = "profile",
         .type = Choice,
         .default_value = "parabolic",
         .help = "velocity profile at the inlet: parabolic, as in a long straight vessel with "
                 "the inlet's shape, or plug, the same everywhere",
         .choices = {"parabolic", "plug"}}};
}

std::vector<Parameter> blood_parameters() {
    const CfdParameters d;
    return {{.name = "density",
             .unit = "kg/m^3",
             .default_value = d.density,
             .help = "of blood",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "viscosity",
             .unit = "Pa s",
             .default_value = d.viscosity,
             .help = "dynamic viscosity of Newtonian blood, the same for all shear rates",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "viscosity_model",
             .type = Choice,
             .default_value = "newtonian",
             .help = "newtonian: viscosity; carreau: falls from 0.056 to 0.00345 Pa s with the "
                     "shear rate (Cho, Kensey 1991)",
             .choices = {"newtonian", "carreau"}}};
}

std::vector<Parameter> solver_parameters() {
    const CfdParameters d;
    return {{.name = "iterations",
             .type = Integer,
             .default_value = std::int64_t{d.iterations},
             .help = "largest number of iterations of simpleFoam; it stops earlier at the residual",
             .minimum = 1,
             .maximum = 1000000},
            {.name = "residual",
             .unit = "-",
             .default_value = d.residual,
             .help = "initial residuals of pressure and velocity at which the run stops",
             .minimum = 0.0,
             .maximum = 1.0,
             .above_minimum = true},
            {.name = "processes",
             .type = Integer,
             .default_value = std::int64_t{d.processes},
             .help = "number of parts made by decomposePar for mpirun",
             .minimum = 1,
             .maximum = 1024}};
}

std::vector<Parameter> pulse_parameters() {
    const CfdParameters d;
    return {{.name = "waveform",
             .type = Text,
             .help = "makes the flow pulsatile: a file with rows of a time [s] and a flow [cm^3/s] "
                     "over one period, in place of flow, or synthetic, a curve that is of no "
                     "measurement, with flow as its mean"},
            {.name = "periods",
             .type = Integer,
             .default_value = std::int64_t{d.periods},
             .help = "of a waveform: number of periods that are computed; the last one counts",
             .minimum = 1,
             .maximum = 100},
            {.name = "steps",
             .type = Integer,
             .default_value = std::int64_t{d.steps},
             .help = "of a waveform: steps of time in a period",
             .minimum = 10,
             .maximum = 100000}};
}

}  // namespace

std::vector<Parameter> flow_parameters() {
    std::vector<Parameter> all = boundary_parameters();
    for (const auto& more : {blood_parameters(), solver_parameters(), pulse_parameters()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

const Operation& flow_table() {
    static const Operation table{.name = "openfoam", .parameters = flow_parameters()};
    return table;
}

namespace {

/// "inlet_1:2.5,inlet_2:1.8"
std::vector<NamedFlow> flows_in(const std::string& text) {
    const Parameter flow{
        .name = "inlet_flows", .unit = "cm^3/s", .help = {}, .minimum = 0.0, .above_minimum = true};
    std::vector<NamedFlow> flows;
    std::istringstream entries(text);
    for (std::string entry; std::getline(entries, entry, ',');) {
        const std::size_t colon = entry.find(':');
        if (colon == std::string::npos)
            throw UsageError("inlet_flows needs name:flow for each inlet, not '" + entry + "'");
        flows.push_back({entry.substr(0, colon),
                         std::get<double>(checked_value(flow, entry.substr(colon + 1)))});
    }
    return flows;
}

constexpr const char* kSynthetic = "synthetic";

/// "0:1.2;0.5:2;1:1.2": the times [s] and flows [cm^3/s] themselves, as kept_waveform() makes it.
bool has_numbers(const std::string& text) {
    return text.find(';') != std::string::npos && text.find(':') != std::string::npos;
}

Waveform waveform_in(std::string text, double mean) {
    if (text == kSynthetic) return synthetic_waveform(mean);
    if (!has_numbers(text)) {
        const std::string name = bare_name(text);
        try {
            return waveform_from_text(file_content(text), name);
        } catch (const IoError&) {
            throw UsageError("openfoam.waveform: '" + name +
                             "' cannot be read; give a file, or synthetic");
        }
    }
    std::ranges::replace(text, ':', ' ');
    std::ranges::replace(text, ';', '\n');
    return waveform_from_text(text, "the project's");
}

/// The waveform, with its mean as the flow.
void take_waveform(CfdParameters& flow, const std::string& text) {
    const bool measured = text != kSynthetic;
    if (measured && !flow.inlet_flows.empty())
        throw UsageError(
            "openfoam.waveform: its file has the flow of all inlets together; leave inlet_flows "
            "out, or give waveform=synthetic");
    double mean = flow.flow;
    if (!flow.inlet_flows.empty()) mean = 0.0;
    for (const NamedFlow& inlet : flow.inlet_flows) mean += inlet.flow;
    flow.waveform = waveform_in(text, mean);
    if (measured) flow.flow = flow.waveform->mean();
}

OutletFlow outlet_flow_in(const std::string& text) {
    return text == "area"           ? OutletFlow::Area
           : text == "cubes"        ? OutletFlow::Cubes
           : text == "bifurcations" ? OutletFlow::Bifurcations
                                    : OutletFlow::ZeroPressure;
}

}  // namespace

CfdParameters flow_from(const Arguments& arguments) {
    CfdParameters flow;
    const auto take = [&](const char* name, double& field) {
        if (arguments.has(name)) field = arguments.real(name);
    };
    take("flow", flow.flow);
    take("density", flow.density);
    take("viscosity", flow.viscosity);
    take("residual", flow.residual);
    take("outlet_exponent", flow.outlet_exponent);
    if (arguments.has("split"))
        flow.split = arguments.text("split") == "cubes" ? FlowSplit::Cubes : FlowSplit::Area;
    if (arguments.has("inlet_flows")) flow.inlet_flows = flows_in(arguments.text("inlet_flows"));
    if (arguments.has("profile"))
        flow.profile =
            arguments.text("profile") == "plug" ? InflowProfile::Plug : InflowProfile::Parabolic;
    if (arguments.has("outlets")) flow.outlets = outlet_flow_in(arguments.text("outlets"));
    if (arguments.has("viscosity_model"))
        flow.viscosity_model = arguments.text("viscosity_model") == "carreau"
                                   ? ViscosityModel::Carreau
                                   : ViscosityModel::Newtonian;
    if (arguments.has("iterations"))
        flow.iterations = static_cast<int>(arguments.integer("iterations"));
    if (arguments.has("processes"))
        flow.processes = static_cast<int>(arguments.integer("processes"));
    if (arguments.has("periods")) flow.periods = static_cast<int>(arguments.integer("periods"));
    if (arguments.has("steps")) flow.steps = static_cast<int>(arguments.integer("steps"));
    if (arguments.has("waveform") && !arguments.text("waveform").empty())
        take_waveform(flow, arguments.text("waveform"));
    return flow;
}

bool is_synthetic(const std::string& waveform) {
    return waveform == kSynthetic;
}

std::string kept_waveform(const std::string& text) {
    if (text.empty() || text == kSynthetic || has_numbers(text)) return text;
    const Waveform wave = waveform_in(text, 1.0);
    std::string kept;
    for (std::size_t i = 0; i < wave.times.size(); ++i)
        kept += (i > 0 ? ";" : "") + formatted(wave.times[i], "%.9g:") +
                formatted(wave.flows[i], "%.9g");
    return kept;
}

}  // namespace vesselbench
