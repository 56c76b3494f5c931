#include "meshing/tetrahedra/tetrahedralize.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "geometry/edges.h"
#include "geometry/errors.h"
#include "geometry/measure.h"
#include "meshing/tetrahedra/cell_order.h"
#include "meshing/tetrahedra/optimise.h"
#include "meshing/tetrahedra/size_field.h"
#include "meshing/tetrahedra/surface_check.h"
#include "meshing/tetrahedra/tetgen_run.h"

namespace vesselbench {

namespace {

// A regular tetrahedron of edge h holds 0.118 h^3. TetGen splits what is larger than the bound, so
// that the mean lies at 0.6 of it: with 0.19 h^3 the mean edge is about h.
constexpr double kVolumeBound = 0.19;
constexpr double kCellsTolerance = 0.1;
constexpr double kVolumeTolerance = 1e-6;

struct Rung {
    std::string switches;  // without the quality bound
    bool keeps_surface;
    const char* remedy;
};

std::vector<Rung> ladder(double quality) {
    char q[32];
    std::snprintf(q, sizeof q, "q%.3g", quality);
    const std::string bound = q;
    return {{"pY" + bound + "/10", true, "the usual settings"},
            {"pY" + bound + "/0O1", true, "no bound on dihedral angles"},
            {"pY" + bound + "/10T1e-11", true, "finer tolerance for coplanar facets"},
            {"pY" + bound + "/10T1e-6", true, "coarser tolerance for coplanar facets"},
            {"pYq2.0/0O1T1e-11", true, "weaker quality bound, finer tolerance"},
            {"p" + bound + "/10", false, "surface triangles may be divided"},
            {"pq2.0/0T1e-6", false, "surface triangles may be divided, coarser tolerance"}};
}

void check_input(const Surface& surface, TetrahedralizeReport& report, const Progress& progress) {
    if (surface.empty()) throw InvalidInput("tetrahedralize: the surface has no triangles");
    std::string obstacles;
    for (const SurfaceProblem& problem : surface_problems(surface, progress)) {
        if (is_obstacle(problem))
            obstacles += "\n  " + to_string(problem);
        else
            report.warnings.push_back(to_string(problem));
    }
    if (!obstacles.empty())
        throw InvalidInput("tetrahedralize: the surface cannot be filled:" + obstacles);
}

std::vector<double> patch_areas(const Positions& points, std::span<const Triangle> triangles,
                                const PatchLabels& labels, std::size_t patches) {
    std::vector<double> areas(patches, 0.0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        areas[labels[t]] += triangle_area(points, triangles[t]);
    return areas;
}

std::vector<std::size_t> patch_counts(const PatchLabels& labels, std::size_t patches) {
    std::vector<std::size_t> counts(patches, 0);
    for (const auto label : labels) ++counts[label];
    return counts;
}

// Cells that hang together through faces; more than one group means that the region fell apart.
std::size_t region_count(const VolumeMesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.tetrahedra.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    };
    std::size_t regions = parent.size();
    for (const MeshFace& face : mesh_faces(mesh)) {
        if (face.neighbour == MeshFace::kOutside) continue;
        const auto a = root(face.owner), b = root(face.neighbour);
        if (a == b) continue;
        parent[std::max(a, b)] = std::min(a, b);
        --regions;
    }
    return regions;
}

// What the mesh lost of the surface; empty: nothing.
std::string loss(const VolumeMesh& mesh, const Surface& surface, bool keeps_surface) {
    if (mesh.tetrahedra.empty()) return "no cells";
    const double wanted = volume(surface), got = volume(mesh);
    if (std::abs(got - wanted) > kVolumeTolerance * wanted)
        return "the cells fill " + std::to_string(got) + " mm^3 of " + std::to_string(wanted);
    for (const auto& [a, b, c, d] : mesh.tetrahedra) {
        const auto& p = mesh.points;
        if ((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) <= 0.0) return "a cell is inverted";
    }
    const std::size_t patches = surface.patches.size();
    if (keeps_surface && patch_counts(mesh.boundary_patches, patches) !=
                             patch_counts(*surface.patch_labels, patches))
        return "boundary triangles were lost or divided";
    const auto before =
        patch_areas(surface.points(), surface.triangles(), *surface.patch_labels, patches);
    const auto after = patch_areas(mesh.points, mesh.boundary, mesh.boundary_patches, patches);
    for (std::size_t k = 0; k < patches; ++k)
        if (std::abs(after[k] - before[k]) > kVolumeTolerance * (before[k] + 1e-12))
            return "patch " + surface.patches[k].name + " lost area";
    return region_count(mesh) == 1 ? "" : "the cells form several regions";
}

class Mesher {
public:
    Mesher(const Surface& surface, const TetrahedralizeParameters& parameters,
           TetrahedralizeReport& report, const Progress& progress)
        : surface_(surface),
          sizes_(surface, parameters.growth),
          rungs_(ladder(parameters.quality)),
          report_(report),
          progress_(progress) {}

    // One mesh, made by the first rung that works.
    VolumeMesh mesh(double factor) {
        const TooLarge too_large = [&](const Vec3& centre, double cell_volume) {
            const double h = sizes_.at(centre, factor);
            return cell_volume > kVolumeBound * h * h * h;
        };
        for (const Rung& rung : rungs_) {
            progress_.check_cancelled();
            TetgenResult result = run_tetgen(surface_, rung.switches, too_large);
            std::string failure = result.error;
            if (failure.empty()) failure = loss(result.mesh, surface_, rung.keeps_surface);
            char note[160];
            std::snprintf(note, sizeof note, "%s (%s), size %.4g: ", rung.switches.c_str(),
                          rung.remedy, factor);
            report_.attempts.push_back(
                note + (failure.empty() ? std::to_string(result.mesh.tetrahedra.size()) + " cells"
                                        : failure));
            if (!failure.empty()) continue;
            report_.switches = rung.switches;
            report_.surface_kept = rung.keeps_surface;
            return std::move(result.mesh);
        }
        fail();
    }

    // Number of cells that a factor will lead to, judged from a mesh of another one.
    [[nodiscard]] double expected_cells(const VolumeMesh& known, double known_factor,
                                        double factor) const {
        double now = 0.0, then = 0.0;
        for (const auto& [a, b, c, d] : known.tetrahedra) {
            const auto& p = known.points;
            const double cell = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]);
            const Vec3 centre = (p[a] + p[b] + p[c] + p[d]) / 4.0;
            now += cell / std::pow(sizes_.at(centre, known_factor), 3);
            then += cell / std::pow(sizes_.at(centre, factor), 3);
        }
        return static_cast<double>(known.tetrahedra.size()) * then / now;
    }

private:
    [[noreturn]] void fail() {
        std::string text = "tetrahedralize: TetGen cannot fill the surface; tried:";
        for (const std::string& attempt : report_.attempts) text += "\n  " + attempt;
        const auto culprits = tetgen_intersecting_facets(surface_);
        for (std::size_t i = 0; i < culprits.size() && i < 5; ++i) {
            const auto& [a, b, c] = surface_.triangles()[culprits[i]];
            const Vec3 centre =
                (surface_.points()[a] + surface_.points()[b] + surface_.points()[c]) / 3.0;
            char place[128];
            std::snprintf(place, sizeof place,
                          "\n  facet %u at (%.4g, %.4g, %.4g) mm meets another one", culprits[i],
                          centre.x(), centre.y(), centre.z());
            text += place;
        }
        throw AlgorithmFailure(text +
                               "\nrun `repair` and `remesh` before it, with a smaller edge length "
                               "where walls lie close");
    }

    const Surface& surface_;
    SizeField sizes_;
    std::vector<Rung> rungs_;
    TetrahedralizeReport& report_;
    const Progress& progress_;
};

double factor_for(const Mesher& mesher, const VolumeMesh& known, double known_factor,
                  double cells) {
    double low = 0.05, high = 20.0;  // the number of cells falls as the factor grows
    for (int step = 0; step < 30; ++step) {
        const double middle = std::sqrt(low * high);
        (mesher.expected_cells(known, known_factor, middle) > cells ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

VolumeMesh mesh_of_size(Mesher& mesher, const TetrahedralizeParameters& parameters,
                        TetrahedralizeReport& report) {
    double factor = parameters.size;
    VolumeMesh mesh = mesher.mesh(factor);
    const auto off = [&] {
        return std::abs(static_cast<double>(mesh.tetrahedra.size()) / *parameters.cells - 1.0);
    };
    for (int trial = 0; parameters.cells && trial < 4 && off() > kCellsTolerance; ++trial) {
        factor = factor_for(mesher, mesh, factor, *parameters.cells);
        mesh = mesher.mesh(factor);
    }
    if (parameters.cells && off() > kCellsTolerance)
        report.warnings.push_back("asked for " + std::to_string(std::lround(*parameters.cells)) +
                                  " cells, reached " + std::to_string(mesh.tetrahedra.size()) +
                                  ": the surface's edge length decides; change it with `remesh`");
    report.size = factor;
    return mesh;
}

}  // namespace

TetrahedralizeResult tetrahedralized(const Surface& given,
                                     const TetrahedralizeParameters& parameters,
                                     const Progress& progress) {
    TetrahedralizeResult result;
    progress.report(0.0, "checking the surface");
    check_input(given, result.report, progress);
    // TetGen would take vertices that no triangle uses as points of the lumen.
    const Surface surface =
        select_triangles(given, std::vector<bool>(given.triangle_count(), true));
    progress.report(0.1, "filling the lumen");
    Mesher mesher(surface, parameters, result.report, progress);
    result.mesh = mesh_of_size(mesher, parameters, result.report);
    result.report.raw = volume_quality(result.mesh);
    if (parameters.improve > 0)
        result.mesh =
            optimised(result.mesh, {.rounds = parameters.improve}, progress.part(0.5, 0.95));
    result.mesh = in_cell_order(std::move(result.mesh));
    const std::string lost = loss(result.mesh, surface, result.report.surface_kept);
    if (!lost.empty())
        throw AlgorithmFailure("tetrahedralize: the improved mesh is not sound (" + lost +
                               "); use improve=0");
    if (!result.report.surface_kept)
        result.report.warnings.emplace_back(
            "TetGen needed to divide triangles of the surface; the volume mesh's boundary is finer "
            "than the surface");
    result.report.quality = volume_quality(result.mesh);
    return result;
}

}  // namespace vesselbench
