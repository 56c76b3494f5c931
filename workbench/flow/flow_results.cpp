#include "workbench/flow/flow_results.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/formats/openfoam_fields.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/vessel/sac/sac_regions.h"
#include "meshing/products/openfoam_control.h"
#include "workbench/flow/flow_run.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Relative difference of areas that single precision leaves.
constexpr double kSameArea = 1e-4;

/// Appends the faces of one patch.
void append_patch(FoamPatchFields& all, const FoamPatchFields& patch) {
    const auto first = static_cast<VertexId>(all.points.size());
    all.points.insert(all.points.end(), patch.points.begin(), patch.points.end());
    for (const auto& [a, b, c] : patch.triangles)
        all.triangles.push_back({a + first, b + first, c + first});
    for (const auto& [name, values] : patch.scalars)
        all.scalars[name].insert(all.scalars[name].end(), values.begin(), values.end());
    for (const auto& [name, values] : patch.vectors)
        all.vectors[name].insert(all.vectors[name].end(), values.begin(), values.end());
}

template <class Field>
const Field& wall_field(const std::map<std::string, Field>& fields, const char* name,
                        std::size_t count, const FlowCase& flow) {
    const auto found = fields.find(name);
    if (found == fields.end() || found->second.size() != count)
        throw InvalidInput("'" + bare_name(flow.folder) + "': the last time has no field " + name +
                           " of this mesh's wall");
    return found->second;
}

/// The areas of the triangles between the made ends, and 0 for the others. All of them are taken
/// if there is nothing between the ends.
std::vector<double> own_areas_of(const FlowWall& wall, const std::vector<MadeEnd>& ends) {
    std::vector<double> areas = wall.areas;
    const std::vector<std::uint8_t> own = comparable_vertices(wall.surface, ends);
    for (TriangleId t = 0; t < wall.surface.triangle_count(); ++t)
        for (const VertexId v : wall.surface.triangles()[t])
            if (own[v] == 0) areas[t] = 0.0;
    return std::ranges::max(areas) > 0.0 ? areas : wall.areas;
}

FlowWall flow_wall(const FlowCase& flow, double time) {
    FoamPatchFields fields;
    for (const std::string& wall : flow.record.walls)
        append_patch(fields, read_foam_patch(flow.folder, wall, time));
    const std::size_t count = fields.triangles.size();
    const double density = flow.record.density;
    const bool pulsatile = flow.record.waveform.has_value();
    FlowWall wall;
    const char* const shear = pulsatile ? cycle_means::kShear : "wallShearStress";
    for (const Vec3& stress : wall_field(fields.vectors, shear, count, flow))
        wall.shear.push_back(-density * stress);
    const char* const pressure = pulsatile ? cycle_means::kPressure : "p";
    for (const double value : wall_field(fields.scalars, pressure, count, flow))
        wall.pressure.push_back(density * value);
    wall.magnitude = magnitudes(wall.shear);
    if (pulsatile) {
        const auto& means = wall_field(fields.scalars, cycle_means::kMagnitude, count, flow);
        for (std::size_t t = 0; t < count; ++t) {
            wall.magnitude[t] = density * means[t];
            wall.cycle.push_back(cycle_shear(wall.shear[t], wall.magnitude[t]));
        }
    }
    for (const Triangle& triangle : fields.triangles)
        wall.areas.push_back(triangle_area(fields.points, triangle));
    wall.surface = make_surface(std::move(fields.points), std::move(fields.triangles));
    wall.own_areas = own_areas_of(wall, flow.record.ends);
    return wall;
}

double total_area(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// \throw InvalidInput unless the preparation's surface has this wall
void require_same_wall(const FlowCase& flow, const FlowWall& wall) {
    const fs::path file = flow.prepared / "surface.vtp";
    if (flow.prepared.empty() || !fs::exists(file)) return;
    const Surface surface = read_surface(file.string()).surface;
    std::size_t triangles = 0;
    double area = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind == PatchKind::Wall) {
            ++triangles;
            area += triangle_area(surface.points(), surface.triangles()[t]);
        }
    const double own = total_area(wall.areas);
    if (triangles == wall.areas.size() && std::abs(area - own) < kSameArea * own) return;
    throw InvalidInput("'" + bare_name(flow.folder) + "' is of another mesh than the surface.vtp " +
                       "beside it (" + std::to_string(wall.areas.size()) + " and " +
                       std::to_string(triangles) + " triangles of the wall): prepare again");
}

/// From the log's head.
std::string solver_of(const FlowCase& flow) {
    const fs::path file = flow.folder / solver_log(flow.record);
    if (!fs::is_regular_file(file)) return "OpenFOAM";
    const std::string log = file_content(file), key = "OPENFOAM=";
    const std::size_t at = log.find(key);
    if (at == std::string::npos) return "OpenFOAM";
    const std::size_t begin = at + key.size();
    return "OpenFOAM " + log.substr(begin, log.find_first_not_of("0123456789", begin) - begin);
}

/// Empty if no neck was marked, or the sac is not on this wall.
std::vector<RegionShear> shear_by_region(const FlowWall& wall,
                                         const std::optional<RecordedNeck>& marked) {
    if (!marked) return {};
    SacRegions found;
    try {
        found = sac_regions(wall.surface, marked->neck,
                            {.reach = marked->reach, .inlet = marked->inlet});
    } catch (const AlgorithmFailure&) {
        return {};
    }
    std::vector<RegionShear> regions;
    for (const SacRegion region : {SacRegion::Sac, SacRegion::Parent, SacRegion::Daughters}) {
        std::vector<double> areas = wall.own_areas;
        for (std::size_t t = 0; t < areas.size(); ++t)
            if (found.triangles[t] != region) areas[t] = 0.0;
        if (std::ranges::max(areas) > 0.0)
            regions.push_back({to_string(region), shear_figures(wall.magnitude, areas)});
    }
    return regions;
}

std::vector<OpeningFigures> opening_figures(const FlowResults& results) {
    std::vector<OpeningFigures> openings;
    for (const RecordedOpening& recorded : results.flow.record.openings) {
        const FlowRecord& record = results.flow.record;
        const double out = counted_value(results.history.flows.at(recorded.name), record);
        openings.push_back(
            {.recorded = recorded,
             .flow = recorded.kind == PatchKind::Inlet ? -out : out,
             .pressure = counted_value(results.history.pressures.at(recorded.name), record)});
    }
    return openings;
}

double imbalance_of(const FlowResults& results) {
    double out = 0.0;
    for (const auto& [name, flows] : results.history.flows)
        out += counted_value(flows, results.flow.record);
    return std::abs(out) / total_inflow(results.history, results.flow.record);
}

/// The history until the fields were written.
void end_history(FlowHistory& history, int last) {
    const auto end = std::ranges::upper_bound(history.iterations, last);
    const auto count = static_cast<std::size_t>(end - history.iterations.begin());
    history.iterations.resize(count);
    history.wall_shear.resize(count);
    for (auto* all : {&history.residuals, &history.pressures, &history.flows})
        for (auto& [name, series] : *all) series.resize(count);
}

/// \throw InvalidInput if the last period of a pulsatile flow is not computed to its end
void require_whole_cycle(const FlowCase& flow, double time) {
    const auto& wave = flow.record.waveform;
    if (!wave || flow.record.steps_until(time) >= wave->all_steps()) return;
    throw InvalidInput("'" + bare_name(flow.folder) + "' has been run to step " +
                       std::to_string(flow.record.steps_until(time)) + " of " +
                       std::to_string(wave->all_steps()) +
                       ": `vesselbench run` goes on there; figures are of the last period");
}

std::optional<double> period_change_of(const FlowSeries& shear, const FlowRecord& record) {
    const std::size_t steps = record.counted_steps();
    if (shear.size() < 2 * steps) return std::nullopt;
    const FlowSeries before(shear.begin(), shear.end() - static_cast<std::ptrdiff_t>(steps));
    return std::abs(counted_value(shear, record) / counted_value(before, record) - 1.0);
}

}  // namespace

CycleFigures cycle_figures(const std::vector<CycleShear>& values,
                           const std::vector<double>& areas) {
    std::vector<double> osi, rrt, ecap;
    CycleFigures figures;
    const double all = total_area(areas);
    for (std::size_t i = 0; i < values.size(); ++i) {
        osi.push_back(values[i].osi);
        rrt.push_back(values[i].rrt);
        ecap.push_back(values[i].ecap);
        figures.osi_mean += areas[i] * values[i].osi / all;
    }
    figures.osi_p95 = weighted_percentile(osi, areas, 0.95);
    figures.rrt_median = weighted_percentile(rrt, areas, 0.5);
    figures.rrt_p95 = weighted_percentile(rrt, areas, 0.95);
    figures.ecap_median = weighted_percentile(ecap, areas, 0.5);
    figures.ecap_p95 = weighted_percentile(ecap, areas, 0.95);
    return figures;
}

std::vector<double> magnitudes(const std::vector<Vec3>& vectors) {
    std::vector<double> sizes;
    for (const Vec3& vector : vectors) sizes.push_back(vector.norm());
    return sizes;
}

ShearFigures shear_figures(const std::vector<double>& values, const std::vector<double>& areas) {
    ShearFigures figures;
    for (std::size_t i = 0; i < values.size(); ++i) {
        figures.area += areas[i];
        figures.mean += areas[i] * values[i];
        if (values[i] < kLowShear) figures.low_area += areas[i];
        if (areas[i] > 0.0) figures.largest = std::max(figures.largest, values[i]);
    }
    if (figures.area > 0.0) figures.mean /= figures.area;
    const auto below = [&](double share) { return weighted_percentile(values, areas, share); };
    figures.p1 = below(0.01);
    figures.p5 = below(0.05);
    figures.median = below(0.5);
    figures.p95 = below(0.95);
    figures.p99 = below(0.99);
    return figures;
}

FlowResults read_flow_results(const FlowCase& flow) {
    const std::optional<double> time = last_whole_time(flow.folder);
    if (!time)
        throw InvalidInput("'" + bare_name(flow.folder) +
                           "' has no results: `vesselbench run` solves the flow first");
    require_whole_cycle(flow, *time);
    FlowResults results{.flow = flow,
                        .time = *time,
                        .history = flow_history(flow.folder, flow.record),
                        .settling = {},
                        .solver = solver_of(flow),
                        .wall = flow_wall(flow, *time),
                        .shear = {},
                        .regions = {},
                        .openings = {}};
    require_same_wall(flow, results.wall);
    const int last = flow.record.steps_until(*time);
    end_history(results.history, last);
    if (results.history.iterations.empty() || results.history.iterations.back() != last)
        throw InvalidInput("'" + bare_name(flow.folder) +
                           "': postProcessing/ lacks the tables of " + "iteration " +
                           time_name(*time) + ": run the case again");
    results.settling = settling_of(results.history, flow.record);
    if (flow.record.waveform) {
        results.converged = true;  // else it is refused
        results.cycle = cycle_figures(results.wall.cycle, results.wall.own_areas);
        results.period_change = period_change_of(results.history.wall_shear, flow.record);
    } else {
        results.converged = results.settling.settled || has_reached_residuals(flow.folder);
    }
    results.shear = shear_figures(results.wall.magnitude, results.wall.own_areas);
    results.regions = shear_by_region(results.wall, flow.record.neck);
    results.openings = opening_figures(results);
    results.pressure_drop = pressure_drop(results.history, flow.record);
    results.imbalance = imbalance_of(results);
    return results;
}

}  // namespace vesselbench
