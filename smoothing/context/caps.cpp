#include "smoothing/context/caps.h"

#include <algorithm>
#include <optional>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "smoothing/context/cap_border.h"
#include "smoothing/context/flat_areas.h"

namespace vesselbench {

namespace {

/// A cap of ascending triangles.
Cap make_cap(const Surface& surface, std::vector<TriangleId> triangles, const Vec3& normal,
             bool from_patch) {
    Cap cap{std::move(triangles), {}, {}, normal, from_patch};
    std::vector<VertexId> corners;
    corners.reserve(3 * cap.triangles.size());
    for (const TriangleId t : cap.triangles)
        corners.insert(corners.end(), surface.triangles()[t].begin(), surface.triangles()[t].end());
    std::sort(corners.begin(), corners.end());
    const Topology& topology = *surface.topology;
    for (std::size_t i = 0, end = 0; i < corners.size(); i = end) {
        const VertexId v = corners[i];
        while (end < corners.size() && corners[end] == v) ++end;
        cap.vertices.push_back(v);
        if (end - i < topology.triangles_at().row(v).size() || topology.boundary_vertices()[v] != 0)
            cap.rim.push_back(v);
    }
    return cap;
}

/// The patches other than the wall.
std::vector<Cap> patch_caps(const AreaNormals& faces) {
    const Surface& surface = faces.surface();
    const auto is_wall = [](const Patch& patch) { return patch.kind == PatchKind::Wall; };
    if (std::ranges::all_of(surface.patches, is_wall)) return {};
    std::vector<std::vector<TriangleId>> triangles(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (!is_wall(surface.patch_of(t))) triangles[(*surface.patch_labels)[t]].push_back(t);
    std::vector<Cap> found;
    for (auto& patch : triangles) {
        if (patch.empty()) continue;
        const Vec3 normal = mean_normal(faces, patch);
        found.push_back(make_cap(surface, std::move(patch), normal, true));
    }
    return found;
}

/// The flat areas whose surroundings make them caps.
std::vector<Cap> flat_caps(const AreaNormals& faces, const CompressedRows& parts,
                           const CapParameters& parameters) {
    const Surface& surface = faces.surface();
    auto areas = find_flat_areas(faces, parts, parameters);
    std::vector<std::optional<Cap>> caps(areas.size());
    tbb::enumerable_thread_specific<CapBorder> borders([&] { return CapBorder(surface); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 4), [&](const auto& range) {
        CapBorder& border = borders.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const Vec3 normal = mean_normal(faces, areas[i]);
            if (!border.encloses_cap(areas[i], normal)) continue;
            std::sort(areas[i].begin(), areas[i].end());
            caps[i] = make_cap(surface, std::move(areas[i]), normal, false);
        }
    });
    std::vector<Cap> found;
    for (auto& cap : caps)
        if (cap) found.push_back(std::move(*cap));
    return found;
}

}  // namespace

void require_cap_parameters(const CapParameters& parameters) {
    require_range("flat_angle_deg", parameters.flat_angle_deg, 0.0, 45.0);
    if (parameters.smallest_faces < 1)
        throw InvalidInput("smallest_faces = " + std::to_string(parameters.smallest_faces) +
                           " must be 1 or more");
}

std::vector<Cap> caps_of_parts(const AreaNormals& faces, const CompressedRows& parts,
                               const CapParameters& parameters) {
    std::vector<Cap> caps = patch_caps(faces);
    if (!parts.values.empty())
        for (Cap& cap : flat_caps(faces, parts, parameters)) caps.push_back(std::move(cap));
    std::stable_sort(caps.begin(), caps.end(), [](const Cap& a, const Cap& b) {
        return a.triangles.front() < b.triangles.front();
    });
    return caps;
}

std::vector<Cap> find_caps(const Surface& surface, const CapParameters& parameters) {
    require_cap_parameters(parameters);
    if (surface.empty()) return {};
    return find_caps(AreaNormals(surface, AreaNormals::When::Ahead), parameters);
}

std::vector<Cap> find_caps(const AreaNormals& faces, const CapParameters& parameters) {
    require_cap_parameters(parameters);
    if (faces.surface().empty()) return {};
    return caps_of_parts(faces, plane_parts(faces, parameters), parameters);
}

std::vector<std::uint8_t> cap_vertices(const std::vector<Cap>& caps, std::size_t vertex_count) {
    std::vector<std::uint8_t> flags(vertex_count, 0);
    for (const Cap& cap : caps)
        for (const VertexId v : cap.vertices) flags[v] = 1;
    return flags;
}

}  // namespace vesselbench
