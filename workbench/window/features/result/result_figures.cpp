#include "workbench/window/features/result/result_figures.h"

#include <algorithm>
#include <functional>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/kernel/wording.h"
#include "meshing/tetrahedra/quality.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

std::size_t count_of(const Surface& surface, PatchKind kind) {
    return static_cast<std::size_t>(std::ranges::count(surface.patches, kind, &Patch::kind));
}

std::string openings_of(const ResultFigures& figures) {
    std::vector<std::string> words;
    if (figures.inlets > 0) words.push_back(counted(figures.inlets, "inlet"));
    if (figures.outlets > 0) words.push_back(counted(figures.outlets, "outlet"));
    if (figures.cuts > 0) words.push_back(counted(figures.cuts, "cut"));
    return words.empty() ? "none" : joined(words);
}

std::string triangles_of(const ResultFigures& figures) {
    return "mean " + readable_number(figures.mean_triangle) + ", worst " +
           readable_number(figures.worst_triangle);
}

}  // namespace

std::optional<ResultFigures> result_figures(const Scene& scene, const Progress& progress) {
    if (!scene.surface || scene.surface->empty()) return std::nullopt;
    const Surface& surface = *scene.surface;
    const Spread shape = wall_shape(surface).radius_ratio;
    ResultFigures figures{.volume = volume(surface),
                          .triangles = surface.triangle_count(),
                          .inlets = count_of(surface, PatchKind::Inlet),
                          .outlets = count_of(surface, PatchKind::Outlet),
                          .cuts = count_of(surface, PatchKind::Cut),
                          .mean_triangle = shape.mean,
                          .worst_triangle = shape.min};
    if (!scene.volume_mesh || scene.volume_mesh->tetrahedra.empty()) return figures;
    figures.cells = scene.volume_mesh->cell_count();
    figures.smallest_angle =
        std::ranges::min(smallest_dihedral_angles(*scene.volume_mesh, progress));
    return figures;
}

std::vector<ResultRow> result_rows(const std::optional<ResultFigures>& before,
                                   const ResultFigures& after) {
    std::vector<ResultRow> rows;
    const auto add = [&](const char* name,
                         const std::function<std::string(const ResultFigures&)>& of) {
        rows.push_back({name, before ? of(*before) : "", of(after)});
    };
    add("Volume", [](const ResultFigures& f) { return readable_number(f.volume) + " mm\u00B3"; });
    add("Openings", openings_of);
    add("Triangles", [](const ResultFigures& f) { return grouped(f.triangles); });
    add("Triangle quality", triangles_of);
    if (after.cells == 0 && (!before || before->cells == 0)) return rows;
    add("Cells", [](const ResultFigures& f) { return f.cells == 0 ? "none" : grouped(f.cells); });
    add("Smallest cell angle", [](const ResultFigures& f) {
        return f.smallest_angle ? readable_number(*f.smallest_angle) + "\u00B0" : "none";
    });
    return rows;
}

}  // namespace vesselbench
