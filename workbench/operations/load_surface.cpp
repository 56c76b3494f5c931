#include <filesystem>

#include <nlohmann/json.hpp>

#include "geometry/edges.h"
#include "geometry/io/surface_file.h"
#include "geometry/measure.h"
#include "workbench/operations/table.h"
#include "workbench/point_json.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

ordered_json report_of(const SurfaceFile& file, const std::string& name) {
    const Surface& surface = file.surface;
    const Vec3 size = bounds(surface).max - bounds(surface).min;
    return {{"file", name},
            {"units", to_string(file.unit)},
            {"units_reason", file.unit_reason},
            {"vertices", surface.vertex_count()},
            {"triangles", surface.triangle_count()},
            {"components", connected_components(*surface.topology).count()},
            {"boundary_loops", surface.topology->boundary_loops().size()},
            {"size_mm", point_json(size)},
            {"notes", file.notes}};
}

Outcome load(const Scene& scene, const Arguments& arguments, Progress& progress) {
    const std::string path = arguments.text("file"), units = arguments.text("units");
    progress.report(0.0, "reading");
    SurfaceFile file =
        read_surface(path, units == "auto" ? std::nullopt : std::optional(length_unit_from(units)));
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.resolved.set("units", to_string(file.unit));
    const std::string name = std::filesystem::path(path).filename().string();
    outcome.report = std::make_shared<ordered_json>(report_of(file, name));
    if (!file.unit_certain)
        outcome.warnings.push_back(name + ": the unit is not certain (" + file.unit_reason +
                                   "); give units=mm, cm or m if this is wrong");
    outcome.scene = with_surface(scene, std::move(file.surface));
    outcome.scene.sampling.reset();
    progress.report(1.0, "read");
    return outcome;
}

}  // namespace

Operation load_surface_operation() {
    using enum ParameterType;
    return {.name = "load-surface",
            .usual_step = Step::Source,
            .allowed = {Step::Source},
            .summary = "read a surface from an STL, PLY, OBJ, OFF, VTP or VTK file",
            .parameters = {{.name = "file",
                            .type = File,
                            .help = "the surface file; its suffix tells the format",
                            .required = true},
                           {.name = "units",
                            .type = Choice,
                            .default_value = std::string("auto"),
                            .help = "unit of the file's coordinates; auto takes what the file "
                                    "states, or the unit in which it has the size of a vessel",
                            .choices = {"auto", "mm", "cm", "m"}}},
            .run = &load,
            .isolated = true,
            .thesis = "3.2"};
}

}  // namespace vesselbench
