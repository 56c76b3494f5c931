// Poses random vessels and prints one line of JSON for each: see scripts/repairs_deform.py.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
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
            {"cap_bulge_mm", cap_bulge(after)},
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

Json deformed(const PosingPhantom& phantom, const CenterlineGraph& graph) {
    const DeformedBranch result =
        deform_branch(phantom.surface, graph,
                      {.at = phantom.at, .move = phantom.move, .straighten = phantom.straighten});
    Json line = facts(phantom.surface, result.surface, {result.axis});
    const Vec3 course = course_at(result.axis.rest, result.from);
    line["miss_mm"] = phantom.straighten > 0.0
                          ? 0.0
                          : (result.to - result.from - phantom.move).cross(course).norm();
    line["move_radii"] = phantom.move.norm() / phantom.radius;
    line["sharpest_radii"] = result.sharpest_radii;
    // The inlet side of the reach, with a margin for the wall across the section.
    std::size_t strayed = 0;
    const Vec3 root = result.axis.rest.front(),
               inward = (result.axis.rest[1] - result.axis.rest[0]).normalized();
    for (std::size_t v = 0; v < phantom.surface.vertex_count(); ++v) {
        const Vec3 away = phantom.surface.points()[v] - root;
        if (away.norm() < 2.0 * phantom.radius && away.dot(inward) < -0.05 * phantom.radius &&
            result.surface.points()[v] != phantom.surface.points()[v])
            ++strayed;
    }
    line["strayed"] = strayed;
    return line;
}

Json parted(const PosingPhantom& phantom, const CenterlineGraph& graph) {
    const PartedBranches result = part_branches(phantom.surface, graph, phantom.gap);
    Json line = facts(phantom.surface, result.surface, result.axes);
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
    const auto start = std::chrono::steady_clock::now();
    try {
        line.update(what == "gap" ? parted(phantom, *graph) : deformed(phantom, *graph));
        line["done"] = true;
    } catch (const DiagnosedFailure& failure) {
        const Diagnostic& why = failure.diagnostics().front();
        line["done"] = false;
        line["code"] = why.code;
        line["placed"] = why.place.has_value();
        line["figures"] = why.figures;
    }
    line["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
