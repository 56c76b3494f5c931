#include "geometry/vessel/ends/stub_sections.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geometry/kernel/whole_section.h"
#include "geometry/vessel/ends/patch_shape.h"

namespace vesselbench {

namespace {

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

std::optional<StubSection> section_at(const Surface& near, const CenterlineGraph& graph,
                                      const Plane& plane) {
    const auto section = whole_section_at(near, plane);
    if (!section || is_passed(graph, *section, plane)) return std::nullopt;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : section->points) least = std::min(least, (p - section->centroid).norm());
    return StubSection{section->diameter(), 2.0 * least};
}

}  // namespace

std::vector<StubSection> stub_sections(const Surface& surface, const CenterlineGraph& graph,
                                       const Stub& stub) {
    const Vec3 way = stub.tip - stub.root;
    const Surface near = part_near(surface, stub.exit, 2.0 * way.norm() + 3.0 * stub.parent);
    const auto towards = [&](const Vec3& end, int k) {
        return section_at(near, graph,
                          {stub.exit + (end - stub.exit) * k / kSections, way.normalized()});
    };
    std::vector<StubSection> outward, inward;
    for (int k = 0; k < kSections; ++k)
        if (const auto width = towards(stub.tip, k)) outward.push_back(*width);
    if (outward.empty()) return {};
    double last = outward.front().diameter;
    for (int k = 1; k < kSections; ++k) {
        const auto width = towards(stub.root, k);
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

}  // namespace vesselbench
