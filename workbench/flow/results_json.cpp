#include "workbench/flow/results_json.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/cfd_parameters.h"
#include "workbench/case/version.h"
#include "workbench/flow/methods_text.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kPercent = 100.0;

std::string low_shear_definition() {
    return "share of the wall's area with a wall shear stress below" +
           formatted(kLowShear, " %g Pa") + " (Malek et al. 1999)";
}

Json flow_case_json(const FlowResults& results) {
    const FlowRecord& record = results.flow.record;
    return {{"folder", bare_name(results.flow.folder)},
            {"provenance", record.provenance},
            {"mesh_sha256", record.mesh},
            {"cells", record.cells},
            {"density_kg_m3", record.density},
            {"viscosity_pa_s", record.viscosity},
            {"viscosity_model", record.carreau ? "Carreau" : "Newtonian"},
            {"profile", record.parabolic ? "parabolic" : "plug"}};
}

/// "OpenFOAM 1912 simpleFoam"
std::string program_text(const FlowResults& results) {
    return results.solver + " " + solver_name(results.flow.record.waveform.has_value());
}

Json pulsatile_json(const FlowResults& results) {
    const RecordedWaveform& wave = *results.flow.record.waveform;
    Json json = {{"kind", "pulsatile"},
                 {"solver", program_text(results)},
                 {"waveform", wave.synthetic ? "synthetic" : "file"},
                 {"period_s", wave.period},
                 {"periods", wave.periods},
                 {"steps_per_period", wave.steps},
                 {"converged", results.converged},
                 {"largest_residual", results.settling.residual}};
    if (results.period_change)
        json["change_of_last_period_percent"] = kPercent * *results.period_change;
    return json;
}

Json solution_json(const FlowResults& results) {
    if (results.flow.record.waveform) return pulsatile_json(results);
    return {{"kind", "steady"},
            {"solver", program_text(results)},
            {"converged", results.converged},
            {"ended_by", results.settling.settled ? "figures"
                         : results.converged      ? "residuals"
                                                  : "iterations"},
            {"iterations", static_cast<int>(results.time)},
            {"largest_change_percent", kPercent * results.settling.change},
            {"largest_residual", results.settling.residual}};
}

Json opening_row(const OpeningFigures& opening) {
    Json row = {{"name", opening.recorded.name},     {"kind", to_string(opening.recorded.kind)},
                {"area_mm2", opening.recorded.area}, {"diameter_mm", opening.recorded.diameter},
                {"flow_cm3_s", opening.flow},        {"pressure_pa", opening.pressure}};
    if (opening.recorded.reynolds) row["reynolds"] = *opening.recorded.reynolds;
    return row;
}

std::string definition_of(const std::string& region) {
    if (region == "sac") return "beyond the marked neck";
    return region == "parent" ? "the vessel with the sac, near its neck"
                              : "the vessels into which the parent parts near the neck";
}

void add_region(const RegionShear& region, std::vector<FlowFigure>& figures) {
    const auto& [name, shear] = region;
    const std::string where = definition_of(name);
    figures.push_back(
        {name + "_wall_area_mm2", name + ": area of its wall", "mm^2", shear.area, where});
    figures.push_back(
        {name + "_wall_shear_mean_pa", name + ": mean wall shear stress", "Pa", shear.mean, where});
    figures.push_back({name + "_wall_shear_max_pa", name + ": largest wall shear stress", "Pa",
                       shear.largest, where});
    figures.push_back({name + "_low_shear_area_percent", name + ": share of low shear", "%",
                       kPercent * shear.low_area / shear.area, where});
}

void add_cycle(const CycleFigures& cycle, std::vector<FlowFigure>& figures) {
    const std::string osi =
        "oscillatory shear index 0.5 (1 - |mean stress vector| / TAWSS) (He, Ku 1996)";
    const std::string rrt = "relative residence time 1 / ((1 - 2 OSI) TAWSS) (Himburg et al. 2004)";
    const std::string ecap =
        "endothelial cell activation potential OSI / TAWSS (Di Achille et al. 2014)";
    figures.insert(figures.end(),
                   {{"osi_mean", "mean OSI", "-", cycle.osi_mean, osi},
                    {"osi_p95", "95th percentile of OSI", "-", cycle.osi_p95, osi},
                    {"rrt_median_per_pa", "median RRT", "1/Pa", cycle.rrt_median, rrt},
                    {"rrt_p95_per_pa", "95th percentile of RRT", "1/Pa", cycle.rrt_p95, rrt},
                    {"ecap_median_per_pa", "median ECAP", "1/Pa", cycle.ecap_median, ecap},
                    {"ecap_p95_per_pa", "95th percentile of ECAP", "1/Pa", cycle.ecap_p95, ecap}});
}

}  // namespace

std::vector<FlowFigure> flow_figures(const FlowResults& results) {
    const ShearFigures& shear = results.shear;
    const auto percentile = [](const char* key, int which, double value) {
        const std::string number = std::to_string(which);
        return FlowFigure{key,
                          number + (which == 1 ? "st" : "th") + " percentile of wall shear stress",
                          "Pa", value, number + " % of the wall's area have less"};
    };
    std::vector<FlowFigure> figures = {
        {"pressure_drop_pa", "pressure drop", "Pa", results.pressure_drop,
         "largest difference of the mean static pressures of two openings"},
        {"mass_imbalance_percent", "imbalance of mass", "%", kPercent * results.imbalance,
         "sum of all flows, relative to the inflow"},
        {"wall_area_mm2", "area of the vessel's own wall", "mm^2", shear.area,
         "without what was extended, and half a diameter before it: all that follows is of it"},
        {"wall_shear_mean_pa", "mean wall shear stress", "Pa", shear.mean,
         results.cycle ? "TAWSS: magnitude, averaged over the last period, weighted by area"
                       : "magnitude, weighted by area"},
        percentile("wall_shear_p1_pa", 1, shear.p1),
        percentile("wall_shear_p5_pa", 5, shear.p5),
        {"wall_shear_median_pa", "median wall shear stress", "Pa", shear.median,
         "half of the wall's area have less"},
        percentile("wall_shear_p95_pa", 95, shear.p95),
        percentile("wall_shear_p99_pa", 99, shear.p99),
        {"wall_shear_max_pa", "largest wall shear stress", "Pa", shear.largest,
         "of one triangle: depends on the mesh"},
        {"low_shear_area_mm2", "area of low shear", "mm^2", shear.low_area, low_shear_definition()},
        {"low_shear_area_percent", "share of low shear", "%",
         kPercent * shear.low_area / shear.area, low_shear_definition()}};
    if (results.cycle) add_cycle(*results.cycle, figures);
    for (const RegionShear& region : results.regions) add_region(region, figures);
    return figures;
}

Json results_json(const FlowResults& results) {
    Json figures = Json::object(), definitions = Json::object(), openings = Json::array();
    for (const FlowFigure& figure : flow_figures(results)) {
        figures[figure.key] = figure.value;
        definitions[figure.key] = figure.definition;
    }
    for (const OpeningFigures& opening : results.openings) openings.push_back(opening_row(opening));
    return {{"program_version", version()},       {"case", flow_case_json(results)},
            {"solution", solution_json(results)}, {"figures", figures},
            {"definitions", definitions},         {"openings", openings},
            {"methods", methods_text(results)},   {"references", method_references(results)}};
}

std::string history_csv(const FlowHistory& history) {
    std::string text = "iteration";  // of a pulsatile flow a step of time
    std::vector<const FlowSeries*> columns;
    const auto add = [&](const std::string& title, const FlowSeries& series) {
        text += "," + title;
        columns.push_back(&series);
    };
    for (const auto& [name, series] : history.residuals) add("residual_" + name, series);
    for (const auto& [name, series] : history.pressures) add(name + "_pressure_pa", series);
    for (const auto& [name, series] : history.flows) add(name + "_outflow_cm3_s", series);
    add("wall_shear_mean_pa", history.wall_shear);
    for (std::size_t row = 0; row < history.iterations.size(); ++row) {
        text += "\n" + std::to_string(history.iterations[row]);
        for (const FlowSeries* series : columns) text += "," + formatted((*series)[row], "%.8g");
    }
    return text + "\n";
}

}  // namespace vesselbench
