#include "smoothing/context/cut_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr double kParallel = 0.999962;  // cosine of 0.5 degrees
constexpr double kStraight = 0.996;     // cosine of 5 degrees: ends of a straight vessel
// Of the largest end's area: smaller ones are no evidence. The image cuts off a tail of an organ as
// flat as its body; of the caps found, small ones are mostly sides of voxels.
constexpr double kSmallCut = 0.01, kSmallCap = 0.1;

template <class Triangles>
CutEnd end_of(const Surface& surface, const Triangles& triangles) {
    CutEnd end;
    Vec3 scaled = Vec3::Zero();
    for (const TriangleId t : triangles) {
        const Triangle& corners = surface.triangles()[t];
        const double area = triangle_area(surface.points(), corners);
        scaled += area_normal(surface.points(), corners);
        end.area += area;
        for (const VertexId v : corners) end.centre += area / 3.0 * surface.points()[v];
    }
    if (end.area > 0.0) end.centre /= end.area;
    if (scaled.norm() > 0.0) end.normal = scaled.normalized();
    return end;
}

bool is_usable(const CutEnd& end) {
    return std::isfinite(end.area) && end.area > 0.0 && end.normal.norm() > 0.5;
}

/// Removes the ends that are small beside the largest one.
std::vector<CutEnd> without_small(std::vector<CutEnd> ends, double share) {
    double largest = 0.0;
    for (const CutEnd& end : ends) largest = std::max(largest, end.area);
    std::erase_if(ends, [&](const CutEnd& end) { return end.area < share * largest; });
    return ends;
}

/// True if some end is beside the line through another one across its plane.
bool are_offset(std::span<const CutEnd* const> ends, const Vec3& axis) {
    for (const CutEnd* a : ends)
        for (const CutEnd* b : ends) {
            const Vec3 between = b->centre - a->centre;
            if (std::abs(between.dot(axis)) < kStraight * between.norm()) return true;
        }
    return false;
}

}  // namespace

std::vector<CutEnd> cut_ends(const Surface& surface) {
    std::vector<std::vector<TriangleId>> parts(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind == PatchKind::Cut)
            parts[(*surface.patch_labels)[t]].push_back(t);
    std::vector<CutEnd> ends;
    for (const auto& part : parts)
        if (const CutEnd end = end_of(surface, part); is_usable(end)) ends.push_back(end);
    return without_small(std::move(ends), kSmallCut);
}

std::vector<CutEnd> cut_ends(const Surface& surface, std::span<const Cap> caps) {
    if (std::vector<CutEnd> known = cut_ends(surface); !known.empty()) return known;
    std::vector<CutEnd> ends;
    for (const Cap& cap : caps) {
        if (cap.from_patch) continue;
        if (const CutEnd end = end_of(surface, cap.triangles); is_usable(end)) ends.push_back(end);
    }
    return without_small(std::move(ends), kSmallCap);
}

std::optional<EndsAxis> axis_of_ends(std::span<const CutEnd> ends) {
    std::optional<EndsAxis> best;
    double best_area = 0.0;
    for (const CutEnd& first : ends) {
        std::vector<const CutEnd*> parallel;
        Vec3 sum = Vec3::Zero();
        double area = 0.0, others = 0.0;
        for (const CutEnd& end : ends) {
            const double cosine = end.normal.dot(first.normal);
            if (std::abs(cosine) < kParallel) {
                others += end.area;
                continue;
            }
            parallel.push_back(&end);
            sum += std::copysign(end.area, cosine) * end.normal;
            area += end.area;
        }
        if (parallel.size() < 2 || area <= best_area) continue;
        const Vec3 axis = sum.normalized();
        if (!are_offset(parallel, axis)) continue;
        const auto count = static_cast<double>(parallel.size());
        best = EndsAxis{axis, std::max(0.0, std::min(count / (count + 1.0), 1.0 - others / area))};
        best_area = area;
    }
    return best;
}

}  // namespace vesselbench
