#include <nlohmann/json.hpp>

#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/shared/surface_argument.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// The unit, and what the file has and a vessel's surface should not.
std::string headline_of(const SurfaceArgument& read, std::size_t components, std::size_t loops) {
    std::string text = "read as " + read.units;
    if (read.turned) text += ", turned from RAS to LPS";
    if (components > 1) text += ", " + counted(components, "part");
    if (loops > 0) text += ", " + counted(loops, "hole or opening", "holes or openings");
    return text;
}

ordered_json report_of(const SurfaceArgument& read) {
    const Surface& surface = read.surface;
    const Vec3 size = bounds(surface).max - bounds(surface).min;
    const std::size_t components = connected_components(*surface.topology).count();
    const std::size_t loops = surface.topology->boundary_loops().size();
    ordered_json report = {{"headline", headline_of(read, components, loops)},
                           {"file", read.name},
                           {"units", read.units},
                           {"units_reason", read.unit_reason},
                           {"axes", read.turned ? "RAS, turned to LPS" : "LPS"},
                           {"vertices", surface.vertex_count()},
                           {"triangles", surface.triangle_count()},
                           {"components", components},
                           {"boundary_loops", loops},
                           {"size_mm", point_json(size)},
                           {"notes", read.notes}};
    if (!read.unit_doubt.empty()) report["units_doubt"] = read.unit_doubt;
    return report;
}

Outcome load(const Scene& scene, const Arguments& arguments, Progress& progress) {
    progress.report(0.0, "reading");
    Outcome outcome;
    outcome.resolved = arguments;
    SurfaceArgument read = read_surface_argument("load-surface", arguments, outcome);
    outcome.report = std::make_shared<ordered_json>(report_of(read));
    outcome.scene = with_surface(scene, std::move(read.surface));
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
            .summary = "read a surface from an " + enumerated(read_names(surface_formats()), "or") +
                       " file",
            .parameters = {{.name = "file",
                            .type = File,
                            .help = "the surface file; its suffix determines the format",
                            .required = true},
                           units_parameter(Meaning::Unit),
                           space_parameter()},
            .run = &load,
            .isolated = true,
            .thesis = "3.2",
            .recipe = {.loads = InputKind::Surface, .makes_source = true},
            .example = {.changed = {{"units", std::string("mm")}}}};
}

}  // namespace vesselbench
