#include "workbench/flow/results_files.h"

#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/formats/vtk_mesh.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "gpu/colours.h"
#include "meshing/products/glb.h"
#include "workbench/case/json_text.h"
#include "workbench/flow/methods_text.h"
#include "workbench/flow/report_section.h"
#include "workbench/flow/results_json.h"
#include "workbench/report/colour_scale.h"
#include "workbench/report/report_pictures.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

std::string shear_label(const FlowResults& results) {
    return results.cycle ? "Time-averaged wall shear stress" : "Wall shear stress";
}

ColourScale shear_scale(const FlowResults& results) {
    return {ColourMap::Ordered, 0.0, results.shear.p99 > 0.0 ? results.shear.p99 : 1.0};
}

std::vector<double> shear_at_vertices(const FlowWall& wall) {
    return values_at_vertices(wall.surface, wall.magnitude, wall.areas);
}

using SharedValues = std::shared_ptr<const std::vector<double>>;

SharedValues shared_values(std::vector<double> values) {
    return std::make_shared<const std::vector<double>>(std::move(values));
}

void add_cycle_arrays(VtkMesh& mesh, const std::vector<CycleShear>& cycle) {
    const auto add = [&](const char* name, double CycleShear::*figure) {
        std::vector<double> values;
        for (const CycleShear& shear : cycle) values.push_back(shear.*figure);
        mesh.cell_values[name] = shared_values(std::move(values));
    };
    add(wall_arrays::kOsi, &CycleShear::osi);
    add(wall_arrays::kRrt, &CycleShear::rrt);
    add(wall_arrays::kEcap, &CycleShear::ecap);
}

void write_wall_vtp(const FlowResults& results, const std::string& path) {
    const FlowWall& wall = results.wall;
    std::vector<double> vectors;
    for (const Vec3& shear : wall.shear)
        vectors.insert(vectors.end(), {shear.x(), shear.y(), shear.z()});
    VtkMesh mesh{.points = wall.surface.points(), .provenance = results.flow.record.provenance};
    for (const Triangle& triangle : wall.surface.triangles()) add_cell(mesh, triangle, 1);
    mesh.patch_names = {"wall"};
    mesh.attributes = {{wall_arrays::kShear, shared_values(shear_at_vertices(wall))},
                       {wall_arrays::kPressure, shared_values(values_at_vertices(
                                                    wall.surface, wall.pressure, wall.areas))}};
    mesh.cell_values = {{wall_arrays::kShearVector, shared_values(std::move(vectors))},
                        {wall_arrays::kShear, shared_values(wall.magnitude)},
                        {wall_arrays::kPressure, shared_values(wall.pressure)}};
    if (!wall.cycle.empty()) add_cycle_arrays(mesh, wall.cycle);
    write_vtk_poly_data(mesh, path);
}

void write_wall_glb(const FlowResults& results, const std::string& path) {
    const ColourScale scale = shear_scale(results);
    GlbColours colours{.name = wall_arrays::kShear,
                       .label = shear_label(results),
                       .unit = "Pa",
                       .least = scale.least,
                       .most = scale.most,
                       .map = legend_colours(scale),
                       .vertices = {}};
    for (const Colour& colour : colours_of(shear_at_vertices(results.wall), scale))
        colours.vertices.push_back({colour.x(), colour.y(), colour.z()});
    write_glb({.surface = results.wall.surface,
               .neighbours = {},
               .colours = std::move(colours),
               .provenance = results.flow.record.provenance},
              path);
}

std::string methods_file(const FlowResults& results) {
    std::string text = methods_text(results) + "\n";
    int number = 0;
    for (const std::string& reference : method_references(results))
        text += "\n[" + std::to_string(++number) + "] " + reference;
    return text + "\n";
}

/// Adds the files to `written`.
class ResultsFolder {
public:
    ResultsFolder(fs::path folder, WrittenResults& written)
        : folder_(std::move(folder)), written_(written) {
        make_folder(folder_);
    }

    /// The path to write a file to.
    [[nodiscard]] std::string path_of(const std::string& name) {
        written_.names.push_back(name);
        return files_.add(folder_ / name).string();
    }

    void add(const std::string& name, const std::string& text) {
        written_.names.push_back(name);
        files_.add_text(folder_ / name, text);
    }

    void commit() { files_.commit(); }

private:
    fs::path folder_;
    WrittenResults& written_;
    PendingFiles files_;
};

/// None without OpenGL: then a warning.
std::vector<ReportPicture> pictures_of(const FlowResults& results, WrittenResults& written) {
    try {
        return shear_pictures(results);
    } catch (const GpuUnavailable& error) {
        written.warnings.push_back({.code = "no-pictures", .words = {{"reason", error.what()}}});
        return {};
    }
}

}  // namespace

std::vector<double> values_at_vertices(const Surface& surface, const std::vector<double>& values,
                                       const std::vector<double>& areas) {
    std::vector<double> sums(surface.vertex_count(), 0.0), weights(surface.vertex_count(), 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        for (const VertexId v : surface.triangles()[t]) {
            sums[v] += areas[t] * values[t];
            weights[v] += areas[t];
        }
    for (std::size_t v = 0; v < sums.size(); ++v)
        if (weights[v] > 0.0) sums[v] /= weights[v];
    return sums;
}

std::vector<ReportPicture> shear_pictures(const FlowResults& results) {
    return measure_pictures(results.wall.surface, shear_at_vertices(results.wall),
                            shear_scale(results), shear_label(results) + " [Pa]");
}

WrittenResults write_flow_results(const FlowResults& results, const fs::path& folder,
                                  const Progress& progress) {
    WrittenResults written;
    progress.report(0.0, "writing the results");
    const std::vector<ReportPicture> pictures = pictures_of(results, written);
    progress.check_cancelled();
    ResultsFolder files(folder, written);
    files.add("results.json", text_from_json(results_json(results), 2) + "\n");
    files.add("methods.txt", methods_file(results));
    files.add("history.csv", history_csv(results.history));
    write_wall_vtp(results, files.path_of("wall.vtp"));
    write_wall_glb(results, files.path_of("wall.glb"));
    for (std::size_t i = 0; i < pictures.size(); ++i)
        files.add("wall_shear_" + std::to_string(i + 1) + ".png", pictures[i].png);
    progress.check_cancelled();
    files.commit();
    if (!results.flow.prepared.empty()) add_flow_section(results, pictures);
    return written;
}

}  // namespace vesselbench
