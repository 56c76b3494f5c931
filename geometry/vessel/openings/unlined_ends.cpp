#include "geometry/vessel/openings/unlined_ends.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

/// Shorter or narrower ones are bumps of the wall: length over width, width over the parent's.
constexpr double kLeastLength = 0.25;
constexpr double kLeastWidth = 0.5;
/// Closer to another end it is a part of it, as a corner of an oblique cap is [diameters].
constexpr double kSameEnd = 1.0;
/// A sac: its sections' diameters rise by this factor behind its neck, or it is so much wider than
/// its parent, as sacs with a line are (surface_ends.cpp).
constexpr double kSacSections = 1.2;
constexpr double kSacToParent = 1.4;
/// What is narrower beside its parent is not the rest of it.
constexpr double kLeastRest = 0.8;
/// A point this far from a stub's tip does not mean it [lengths of the stub].
constexpr double kFarthest = 2.0;
constexpr int kSections = 10;
/// Within its parent's spheres, sections are a stub's own while they grow inward by no more than
/// these factors, from one to the next and in all; then they run along the parent.
constexpr double kOwnStep = 1.1;
constexpr double kOwnGrowth = 1.25;

/// True if a centerline passes the section: it is that vessel's.
bool is_passed(const CenterlineGraph& graph, const SectionCurve& section, const Plane& plane) {
    for (const CenterlineBranch& branch : graph.branches)
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
            const Vec3 &a = branch.points[i], &b = branch.points[i + 1];
            const double from = plane.distance(a), to = plane.distance(b);
            if ((from < 0.0) != (to < 0.0) &&
                encloses(section, plane, a + from / (from - to) * (b - a)))
                return true;
        }
    return false;
}

/// Of a section across a stub.
struct Width {
    double diameter = 0.0;   ///< of the circle of its area [mm]
    double inscribed = 0.0;  ///< of the largest circle about its middle [mm]
};

class StubSections {
public:
    StubSections(const Surface& surface, const CenterlineGraph& graph, const Stub& stub)
        : near_(part_near(surface, stub.exit,
                          2.0 * (stub.tip - stub.root).norm() + 3.0 * stub.parent)),
          graph_(graph),
          normal_((stub.tip - stub.root).normalized()) {}

    /// From the innermost one that is the stub's own to its tip. Empty: it has none beyond its
    /// parent's spheres.
    [[nodiscard]] std::vector<Width> across(const Stub& stub) const {
        std::vector<Width> outward, inward;
        for (int k = 0; k < kSections; ++k)
            if (const auto width = at(stub.exit + (stub.tip - stub.exit) * k / kSections))
                outward.push_back(*width);
        if (outward.empty()) return {};
        double last = outward.front().diameter;
        for (int k = 1; k < kSections; ++k) {
            const auto width = at(stub.exit + (stub.root - stub.exit) * k / kSections);
            if (!width || width->diameter > kOwnStep * last ||
                width->diameter > kOwnGrowth * outward.front().diameter)
                break;
            inward.push_back(*width);
            last = width->diameter;
        }
        std::ranges::reverse(inward);
        inward.insert(inward.end(), outward.begin(), outward.end());
        return inward;
    }

private:
    [[nodiscard]] std::optional<Width> at(const Vec3& point) const {
        const Plane plane{point, normal_};
        const auto section = cross_section_at(near_, plane);
        if (!section || !section->closed || !encloses(*section, plane, point) ||
            is_passed(graph_, *section, plane))
            return std::nullopt;
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& p : section->points)
            least = std::min(least, (p - section->centroid).norm());
        return Width{section->diameter(), 2.0 * least};
    }

    Surface near_;
    const CenterlineGraph& graph_;
    Vec3 normal_;
};

bool is_part_of(const Stub& stub, const SurfaceEnd& end, const CenterlineGraph& graph) {
    const Vec3& at = end.tip ? graph.nodes[*end.tip].position : end.centre;
    return std::min((at - stub.tip).norm(), (end.centre - stub.tip).norm()) <
           kSameEnd * end.diameter;
}

std::optional<UnlinedEnd> end_of(const Stub& stub, const std::vector<Width>& widths) {
    double neck = std::numeric_limits<double>::infinity(), rise = 1.0, widest = 0.0, round = 0.0;
    for (const Width& width : widths) {
        neck = std::min(neck, width.diameter);
        rise = std::max(rise, width.diameter / neck);
        widest = std::max(widest, width.diameter);
        round = std::max(round, width.inscribed);
    }
    const double parent = 2.0 * stub.parent;
    if (widths.empty() || stub.length < kLeastLength * round || round < kLeastWidth * parent)
        return std::nullopt;
    const bool rest = rise <= kSacSections && round >= kLeastRest * parent;
    return UnlinedEnd{.place = stub.tip,
                      .diameter = round,
                      .length = stub.length,
                      .sac = rise > kSacSections || widest > kSacToParent * parent,
                      .rest_of = rest ? parent : 0.0};
}

}  // namespace

std::vector<UnlinedEnd> unlined_ends(const Surface& surface, const CenterlineGraph& graph,
                                     const std::vector<Stub>& stubs,
                                     const std::vector<SurfaceEnd>& ends) {
    std::vector<UnlinedEnd> found;
    for (const Stub& stub : stubs) {
        const double least = std::max(stub.widest, kLeastWidth * stub.parent);
        if (stub.length < kLeastLength * 2.0 * least) continue;
        if (std::ranges::any_of(ends, [&](const auto& e) { return is_part_of(stub, e, graph); }))
            continue;
        if (const auto end = end_of(stub, StubSections(surface, graph, stub).across(stub)))
            found.push_back(*end);
    }
    return found;
}

LinesAndStubs lines_to_ends(const Surface& surface, const Positions& points,
                            const Progress& progress) {
    LinesAndStubs lines{centerlines_of(surface, {}, progress), *stubs_of(surface)};
    Positions ends;
    for (const Vec3& point : points) {
        const auto tip = nearest_tip(*lines.graph, point);
        const double beside = tip ? (lines.graph->nodes[*tip].position - point).norm()
                                  : std::numeric_limits<double>::infinity();
        const auto stub = std::ranges::find_if(lines.stubs, [&](const Stub& s) {
            const double distance = (s.tip - point).norm();
            return distance < beside && distance <= kFarthest * s.length;
        });
        if (stub == lines.stubs.end()) continue;
        ends.push_back(stub->tip);
        lines.stubs.erase(stub);
    }
    if (!ends.empty()) lines.graph = centerlines_of(surface, {.ends = ends}, progress);
    return lines;
}

}  // namespace vesselbench
