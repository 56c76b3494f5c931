// Poses random vessels and prints one line of JSON for each: see scripts/repairs_deform.py.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/posing/deform_branch.h"
#include "geometry/vessel/posing/part_branches.h"
#include "meshing/products/print_check.h"
#include "tests/support/posing_phantoms.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

double equal_radius(const Surface& surface, const Positions& axis, std::size_t i) {
    const auto curve =
        cross_section_at(surface, {axis[i], (axis[i + 1] - axis[i - 1]).normalized()});
    return curve && curve->closed ? std::sqrt(std::abs(curve->area) / M_PI) : 0.0;
}

/// Largest relative change of the radius of a section, over all sections of what bends.
double radius_error(const Surface& before, const Surface& after,
                    const std::vector<BentAxis>& axes) {
    double most = 0.0;
    for (const BentAxis& axis : axes)
        for (std::size_t i = 2; i + 2 < axis.rest.size(); i += 3) {
            const double was = equal_radius(before, axis.rest, i),
                         is = equal_radius(after, axis.bent, i);
            if (was > 0.0) most = std::max(most, std::abs(is / was - 1.0));
        }
    return most;
}

double cap_bulge(const Surface& surface) {
    double most = 0.0;
    for (const PatchMeasures& patch : measure_patches(surface))
        if (patch.kind != PatchKind::Wall) most = std::max(most, patch.flatness);
    return most;
}

Json facts(const Surface& before, const Surface& after, const std::vector<BentAxis>& axes) {
    const Connectivity c = connectivity(*after.topology);
    return {{"radius_error", radius_error(before, after, axes)},
            {"volume_error", std::abs(volume(after) / volume(before) - 1.0)},
            {"sound", c.closed && c.manifold && self_intersections(after).empty()},
            {"cap_bulge_mm", cap_bulge(after) - cap_bulge(before)},
            {"labels_kept", after.patch_labels == before.patch_labels}};
}

/// Unit direction of an axis at its point that is nearest to a place.
Vec3 course_at(const Positions& axis, const Vec3& place) {
    const auto nearest = std::ranges::min_element(
        axis, {}, [&](const Vec3& point) { return (point - place).squaredNorm(); });
    const auto i = std::clamp<std::ptrdiff_t>(nearest - axis.begin(), 1,
                                              static_cast<std::ptrdiff_t>(axis.size()) - 2);
    return (axis[static_cast<std::size_t>(i + 1)] - axis[static_cast<std::size_t>(i - 1)])
        .normalized();
}

/// The section of the axis at rest where the reach of a deformation begins, pointing along it.
Plane reach_begin(const DeformedBranch& result) {
    const Positions& axis = result.axis.rest;
    std::size_t at = 0;
    for (std::size_t i = 1; i < axis.size(); ++i)
        if ((axis[i] - result.from).norm() < (axis[at] - result.from).norm()) at = i;
    double left = result.reach;
    std::size_t first = at;
    for (; first > 0 && left > 0.0; --first) left -= (axis[first] - axis[first - 1]).norm();
    return {axis[first], (axis[first + 1] - axis[first]).normalized()};
}

/// What the inlet reaches along the surface without passing the section where the reach begins,
/// with a margin: must keep its bits.
std::vector<VertexId> vertices_before_reach(const PosingPhantom& phantom,
                                            const DeformedBranch& result) {
    const Surface& surface = phantom.surface;
    const Plane begin = reach_begin(result);
    std::vector<std::uint8_t> seen(surface.vertex_count(), 0);
    std::vector<VertexId> reached;
    const auto reach = [&](VertexId v) {
        const Vec3 away = surface.points()[v] - begin.point;
        const bool passes =
            away.norm() < 2.0 * phantom.radius && away.dot(begin.normal) > -0.1 * phantom.radius;
        if (seen[v] != 0 || passes) return;
        seen[v] = 1;
        reached.push_back(v);
    };
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind == PatchKind::Inlet)
            for (const VertexId v : surface.triangles()[t]) reach(v);
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const VertexId u : surface.topology->rings().row(reached[i])) reach(u);
    return reached;
}

/// Processor time of all threads [s].
double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

Json deformed(const PosingPhantom& phantom, const CenterlineGraph& graph) {
    const std::clock_t start = std::clock();
    const DeformedBranch result =
        deform_branch(phantom.surface, graph,
                      {.at = phantom.at, .move = phantom.move, .straighten = phantom.straighten});
    const double seconds = seconds_since(start);
    Json line = facts(phantom.surface, result.surface, {result.axis});
    line["cpu_seconds"] = seconds;
    const Vec3 course = course_at(result.axis.rest, result.from);
    line["miss_mm"] = phantom.straighten > 0.0
                          ? 0.0
                          : (result.to - result.from - phantom.move).cross(course).norm();
    line["move_radii"] = phantom.move.norm() / phantom.radius;
    line["sharpest_radii"] = result.sharpest_radii;
    const auto root_side = vertices_before_reach(phantom, result);
    line["root_side"] = root_side.size();
    const auto strayed = std::ranges::count_if(root_side, [&](VertexId v) {
        return result.surface.points()[v] != phantom.surface.points()[v];
    });
    line["strayed"] = strayed;
    return line;
}

Json parted(const PosingPhantom& phantom, const CenterlineGraph& graph) {
    const std::clock_t start = std::clock();
    const PartedBranches result = part_branches(phantom.surface, graph, phantom.gap);
    const double seconds = seconds_since(start);
    Json line = facts(phantom.surface, result.surface, result.axes);
    line["cpu_seconds"] = seconds;
    const auto check = print_check(result.surface);
    line["gaps"] = result.gaps.size();
    line["gap_before_mm"] = result.gaps.empty() ? -1.0 : result.gaps.front().before;
    line["gap_after_mm"] = result.smallest_after;
    line["print_gap_mm"] = check.gap ? check.gap->distance : 1e9;
    line["largest_shift_mm"] = result.shifts.empty() ? 0.0 : result.shifts.front().largest;
    line["rounds"] = result.rounds;
    return line;
}

Json trial(const std::string& what, std::uint64_t seed) {
    const PosingPhantom phantom = what == "gap" ? gap_phantom(seed) : deform_phantom(seed);
    Json line = {{"what", what},
                 {"seed", seed},
                 {"kind", phantom.kind},
                 {"triangles", phantom.surface.triangle_count()},
                 {"to_refuse", phantom.refused},
                 {"crossings_before", self_intersections(phantom.surface).size()}};
    if (what == "gap") {
        const auto gap = print_check(phantom.surface).gap;
        line["print_gap_before_mm"] = gap ? gap->distance : 1e9;
    }
    const auto graph = centerlines_of(phantom.surface);
    const std::clock_t start = std::clock();
    try {
        line.update(what == "gap" ? parted(phantom, *graph) : deformed(phantom, *graph));
        line["done"] = true;
    } catch (const DiagnosedFailure& failure) {
        const Diagnostic& why = failure.diagnostics().front();
        line["done"] = false;
        line["code"] = why.code;
        line["placed"] = why.place.has_value();
        line["figures"] = why.figures;
        line["cpu_seconds"] = seconds_since(start);
    }
    return line;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::cerr << "usage: bench_posing deform|gap FIRST_SEED LAST_SEED\n";
        return 2;
    }
    for (std::uint64_t seed = std::stoull(argv[2]); seed <= std::stoull(argv[3]); ++seed)
        std::cout << trial(argv[1], seed).dump() << std::endl;
    return 0;
}
