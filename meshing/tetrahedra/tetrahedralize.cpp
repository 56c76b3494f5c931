#include "meshing/tetrahedra/tetrahedralize.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "meshing/tetrahedra/cell_order.h"
#include "meshing/tetrahedra/mesh_check.h"
#include "meshing/tetrahedra/optimise.h"
#include "meshing/tetrahedra/size_field.h"
#include "meshing/tetrahedra/surface_check.h"
#include "meshing/tetrahedra/tetgen_failure.h"
#include "meshing/tetrahedra/tetgen_run.h"

namespace vesselbench {

namespace {

// A regular tetrahedron of edge h has a volume of 0.118 h^3. TetGen splits cells above the bound,
// so the mean is 0.6 of it: with 0.19 h^3 the mean edge is about h.
constexpr double kVolumeBound = 0.19;
// Cells that TetGen makes in a cube of the target edge length, with the bound above.
constexpr double kCellsPerCube = 9.9;
constexpr double kCellsTolerance = 0.08;
// Where the lumen is finer than this factor, the steep transition to the wall takes more: with it,
// the count was within 7 % of the expected one for six vessels and factors of 0.06 to 1.4.
constexpr double kSteep = 0.5, kMoreWhereSteep = 0.2;  // the latter by the logarithm
// A count that changes less although the size was changed is that of the surface's own edges.
constexpr double kSameCells = 0.05;
// Exchanges leave this fraction of TetGen's cells.
constexpr double kCellsAfterExchanges = 0.945;

struct Rung {
    std::string switches;  // without the quality bound
    bool keeps_surface;
    const char* remedy;
};

std::vector<Rung> ladder(double quality, bool may_divide) {
    const std::string bound = formatted(quality, "q%.3g");
    std::vector<Rung> rungs = {
        {"pY" + bound + "/10", true, "the usual settings"},
        {"pY" + bound + "/0O1", true, "no bound on dihedral angles"},
        {"pY" + bound + "/10T1e-11", true, "finer tolerance for coplanar facets"},
        {"pY" + bound + "/10T1e-6", true, "coarser tolerance for coplanar facets"},
        {"pYq2.0/0O1T1e-11", true, "weaker quality bound, finer tolerance"},
        {"p" + bound + "/10", false, "surface triangles may be divided"},
        {"pq2.0/0T1e-6", false, "surface triangles may be divided, coarser tolerance"}};
    if (!may_divide) std::erase_if(rungs, [](const Rung& rung) { return !rung.keeps_surface; });
    return rungs;
}

void check_input(const Surface& surface, std::vector<Diagnostic>& warnings,
                 const Progress& progress) {
    if (surface.empty()) throw InvalidInput("the surface has no triangles");
    std::vector<Diagnostic> obstacles;
    for (const SurfaceProblem& problem : surface_problems(surface, progress))
        (is_obstacle(problem) ? obstacles : warnings).push_back(diagnostic_of(problem));
    if (obstacles.empty()) return;
    std::string list;
    for (const Diagnostic& obstacle : obstacles) list += "\n  " + text_of(obstacle);
    Diagnostic whole{.code = "surface-not-fillable",
                     .operation = "tetrahedralize",
                     .place = obstacles.front().place,
                     .words = {{"obstacles", list}},
                     .remedies = obstacles.front().remedies};
    obstacles.insert(obstacles.begin(), std::move(whole));
    throw DiagnosedInput(std::move(obstacles));
}

// Points that fill a tetrahedron evenly, as weights of three of its corners.
// Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018 (R3); sorting
// folds the unit cube to the tetrahedron.
Vec3 place_in_tetrahedron(int k) {
    constexpr double g = 1.2207440846057596;
    std::array<double, 3> t;
    for (int i = 0; i < 3; ++i) t[i] = std::fmod(0.5 + (k + 1) / std::pow(g, i + 1), 1.0);
    std::sort(t.begin(), t.end());
    return {t[0], t[1] - t[0], t[2] - t[1]};
}

// Target sizes are linear in the factor.
struct VolumeSample {
    double volume;                    // [mm^3]
    double smallest_size, by_factor;  // [mm]

    [[nodiscard]] double size(double factor) const { return smallest_size + factor * by_factor; }
};

class Mesher {
public:
    Mesher(const Surface& surface, const TetrahedralizeParameters& parameters,
           TetrahedralizeReport& report, Progress progress)
        : surface_(surface),
          sizes_(surface, parameters.growth),
          rungs_(ladder(parameters.quality, parameters.may_divide)),
          report_(report),
          progress_(std::move(progress)) {}

    // One mesh, made by the first rung of the ladder that works.
    VolumeMesh mesh(double factor) {
        const TooLarge too_large = [&](const Vec3& centre, double cell_volume) {
            report_progress();
            const double h = sizes_.at(centre, factor);
            return cell_volume > kVolumeBound * h * h * h;
        };
        for (const Rung& rung : rungs_) {
            progress_.check_cancelled();
            TetgenResult result = run_tetgen(surface_, rung.switches, too_large);
            std::string failure = result.error;
            std::vector<MeshFace> faces;
            if (failure.empty()) faces = mesh_faces(result.mesh);
            if (failure.empty())
                failure = mesh_loss(result.mesh, faces, surface_, rung.keeps_surface);
            report_.attempts.push_back(
                rung.switches + " (" + rung.remedy + "), size " + formatted(factor, "%.4g") + ": " +
                (failure.empty() ? std::to_string(result.mesh.tetrahedra.size()) + " cells"
                                 : failure));
            if (!failure.empty()) continue;
            report_.switches = rung.switches;
            report_.surface_kept = rung.keeps_surface;
            report_.raw = volume_quality(result.mesh, faces);
            return std::move(result.mesh);
        }
        throw DiagnosedFailure(
            tetgen_failure(surface_, report_.attempts, tetgen_intersecting_facets(surface_)));
    }

    // Distribution of the lumen's volume over the target sizes: samples of a coarse filling.
    [[nodiscard]] std::vector<VolumeSample> samples() const {
        std::vector<VolumeSample> all;
        const VolumeMesh coarse = run_tetgen(surface_, "pY").mesh;
        for (const auto& [a, b, c, d] : coarse.tetrahedra) {
            const auto& p = coarse.points;
            const double cell = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]) / 6.0;
            const double size = sizes_.at((p[a] + p[b] + p[c] + p[d]) / 4.0, 1.0);
            const int count =
                static_cast<int>(std::clamp(2.0 * cell / std::pow(size, 3), 4.0, 1e3));
            for (int k = 0; k < count; ++k) {
                const Vec3 w = place_in_tetrahedron(k);
                const Vec3 place =
                    p[a] + w.x() * (p[b] - p[a]) + w.y() * (p[c] - p[a]) + w.z() * (p[d] - p[a]);
                const double smallest_size = sizes_.at(place, 0.0);
                all.push_back({cell / count, smallest_size, sizes_.at(place, 1.0) - smallest_size});
            }
        }
        return all;
    }

private:
    /// TetGen reports nothing, but asks about every cell that it may divide; how many there will
    /// be is not known.
    void report_progress() {
        constexpr std::size_t kBetween = 1 << 14, kMany = 1 << 20;
        if (++asked_ % kBetween == 0)
            progress_.report(static_cast<double>(asked_) / static_cast<double>(asked_ + kMany),
                             "filling the lumen");
    }

    const Surface& surface_;
    SizeField sizes_;
    std::vector<Rung> rungs_;
    TetrahedralizeReport& report_;
    Progress progress_;
    std::size_t asked_ = 0;
};

double expected_cells(const std::vector<VolumeSample>& samples, double factor) {
    double cells = 0.0;
    for (const VolumeSample& sample : samples)
        cells += sample.volume / std::pow(sample.size(factor), 3);
    const double steep = std::max(0.0, std::log(kSteep / factor));
    return kCellsPerCube * (1.0 + kMoreWhereSteep * steep) * cells;
}

double factor_for(const std::vector<VolumeSample>& samples, double cells) {
    double low = 0.05, high = 20.0;  // the number of cells falls as the factor grows
    for (int step = 0; step < 20; ++step) {
        const double middle = std::sqrt(low * high);
        (expected_cells(samples, middle) > cells ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

VolumeMesh mesh_of_size(Mesher& mesher, const TetrahedralizeParameters& parameters,
                        TetrahedralizeReport& report) {
    report.size = parameters.size;
    if (!parameters.cells) return mesher.mesh(report.size);
    const double wanted = *parameters.cells / (parameters.improve > 0 ? kCellsAfterExchanges : 1.0);
    const auto samples = mesher.samples();
    VolumeMesh mesh;
    double aim = wanted;
    for (int trial = 0; trial < 4; ++trial) {
        report.size = factor_for(samples, aim);
        const auto before = static_cast<double>(mesh.tetrahedra.size()) / wanted;
        mesh = mesher.mesh(report.size);
        const double reached = static_cast<double>(mesh.tetrahedra.size()) / wanted;
        if (std::abs(reached - 1.0) < kCellsTolerance) break;
        if (std::abs(reached - before) < kSameCells * reached) break;
        aim /= reached;
    }
    return mesh;
}

// Below this factor the lumen is resolved much finer than the wall, where the shear matters.
constexpr double kFineLumen = 0.6;

}  // namespace

void warn_of_cell_count(double wanted, TetrahedralizeReport& report) {
    const auto reached = static_cast<double>(report.quality.cells);
    const std::vector<Remedy> remesh = {{.operation = "remesh"}};
    if (std::abs(reached / wanted - 1.0) > 0.1)
        report.warnings.push_back({.code = "cells-limited",
                                   .figures = {{"wanted", wanted}, {"reached", reached}},
                                   .remedies = remesh});
    else if (report.size < kFineLumen)
        report.warnings.push_back({.code = "lumen-finer-than-wall",
                                   .figures = {{"size", report.size}, {"wanted", wanted}},
                                   .remedies = remesh});
}

Surface fillable_surface(const Surface& given, std::vector<Diagnostic>& warnings,
                         const Progress& progress) {
    progress.report(0.0, "checking the surface");
    check_input(given, warnings, progress);
    // TetGen would take unused vertices as points of the lumen.
    return select_triangles(given, std::vector<bool>(given.triangle_count(), true));
}

TetrahedralizeResult fill_lumen(const Surface& surface, const TetrahedralizeParameters& parameters,
                                const Progress& progress) {
    TetrahedralizeResult result;
    progress.report(0.0, "filling the lumen");
    Mesher mesher(surface, parameters, result.report, progress.part(0.0, 0.45));
    result.mesh = mesh_of_size(mesher, parameters, result.report);
    if (parameters.improve > 0)
        result.mesh =
            optimised(result.mesh, {.rounds = parameters.improve}, progress.part(0.45, 0.95));
    progress.report(0.95, "checking the cells");
    CellNeighbours neighbours;
    result.mesh = in_cell_order(std::move(result.mesh), neighbours);
    const std::vector<MeshFace> faces = mesh_faces(result.mesh, neighbours);
    const std::string lost = mesh_loss(result.mesh, faces, surface, result.report.surface_kept);
    if (!lost.empty())
        throw DiagnosedFailure({.code = "improved-mesh-invalid",
                                .operation = "tetrahedralize",
                                .words = {{"reason", lost}},
                                .remedies = {{.arguments = {{"improve", "0"}}}}});
    if (!result.report.surface_kept) result.report.warnings.push_back({.code = "surface-divided"});
    result.report.quality = volume_quality(result.mesh, faces);
    return result;
}

TetrahedralizeResult tetrahedralized(const Surface& given,
                                     const TetrahedralizeParameters& parameters,
                                     const Progress& progress) {
    std::vector<Diagnostic> warnings;
    const Surface surface = fillable_surface(given, warnings, progress.part(0.0, 0.1));
    TetrahedralizeResult result = fill_lumen(surface, parameters, progress.part(0.1, 1.0));
    result.report.warnings.insert(result.report.warnings.begin(), warnings.begin(), warnings.end());
    if (parameters.cells) warn_of_cell_count(*parameters.cells, result.report);
    return result;
}

}  // namespace vesselbench
