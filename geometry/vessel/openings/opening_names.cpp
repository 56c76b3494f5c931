#include "geometry/vessel/openings/opening_names.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

std::vector<double> patch_areas(const Surface& surface) {
    std::vector<double> areas(surface.patches.size(), 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        areas[(*surface.patch_labels)[t]] +=
            0.5 * area_normal(surface.points(), surface.triangles()[t]).norm();
    return areas;
}

int rank(PatchKind kind) {
    switch (kind) {
        case PatchKind::Inlet:
            return 0;
        case PatchKind::Outlet:
            return 1;
        case PatchKind::Cut:
            return 2;
        case PatchKind::Wall:
            return 3;
    }
    return 3;
}

/// Patches 1... ordered by kind, then by descending area.
Surface ordered(const Surface& surface, const std::vector<Patch>& patches,
                const std::vector<double>& areas) {
    std::vector<std::size_t> order(patches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
        const int ra = rank(patches[a].kind), rb = rank(patches[b].kind);
        return ra != rb ? ra < rb : areas[a] > areas[b];
    });
    std::vector<std::uint16_t> new_label(patches.size());
    std::vector<Patch> table;
    for (const std::size_t p : order) {
        new_label[p] = static_cast<std::uint16_t>(table.size());
        table.push_back(patches[p]);
    }
    PatchLabels labels = *surface.patch_labels;
    for (auto& label : labels) label = new_label[label];
    return surface.with_patches(std::move(labels), std::move(table));
}

}  // namespace

std::string free_patch_name(const std::string& stem, int first, const std::vector<Patch>& patches) {
    for (int k = first;; ++k) {
        std::string name = k == 0 ? stem : stem + "_" + std::to_string(k);
        if (std::none_of(patches.begin(), patches.end(),
                         [&](const Patch& p) { return p.name == name; }))
            return name;
    }
}

Surface name_openings(const Surface& surface, const std::vector<std::string>& unnamed,
                      const std::optional<Vec3>& inlet, bool promote) {
    auto patches = surface.patches;
    const auto areas = patch_areas(surface);
    std::vector<std::size_t> open;
    for (std::size_t p = 1; p < patches.size(); ++p)
        if (patches[p].kind == PatchKind::Cut &&
            std::find(unnamed.begin(), unnamed.end(), patches[p].name) != unnamed.end())
            open.push_back(p);
    std::stable_sort(open.begin(), open.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    const auto make_inlet = [&](std::size_t p) {
        patches[p].kind = PatchKind::Inlet;
        // Files keep names only: an inlet called outlet_1 would be an outlet again.
        if (std::erase(open, p) > 0 || patches[p].name.starts_with("outlet"))
            patches[p].name = free_patch_name("inlet", 0, patches);
    };
    const bool has_inlet = std::any_of(patches.begin(), patches.end(),
                                       [](const Patch& p) { return p.kind == PatchKind::Inlet; });
    if (inlet) {
        for (auto& patch : patches)
            if (patch.kind == PatchKind::Inlet)
                patch = {patch.name == "inlet" ? free_patch_name("outlet", 1, patches) : patch.name,
                         PatchKind::Outlet};
        if (const auto p = nearest_opening(surface, *inlet)) make_inlet(*p);
    } else if (!has_inlet && areas.size() > 1) {
        const auto largest = std::max_element(areas.begin() + 1, areas.end());
        const auto p = static_cast<std::size_t>(largest - areas.begin());
        if (!open.empty() && (promote || p == open.front()))
            make_inlet(open.front());
        else if (open.empty() && promote && patches[p].kind == PatchKind::Outlet)
            make_inlet(p);
    }
    for (const std::size_t p : open) {
        patches[p].kind = PatchKind::Outlet;
        patches[p].name = free_patch_name("outlet", 1, patches);
    }
    return ordered(surface, patches, areas);
}

std::optional<std::size_t> nearest_opening(const Surface& surface, const Vec3& point) {
    std::optional<std::size_t> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        if (surface.patches[p].kind == PatchKind::Wall) continue;
        const double d = (patch_shape(surface, p).plane.point - point).norm();
        if (d < nearest) {
            nearest = d;
            best = p;
        }
    }
    return best;
}

}  // namespace vesselbench
