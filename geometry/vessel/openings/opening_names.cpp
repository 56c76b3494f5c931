#include "geometry/vessel/openings/opening_names.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
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

struct Moment {
    Vec3 of_area = Vec3::Zero();  ///< [mm^3]
    double area = 0.0;            ///< [mm^2]
};

/// By patch; 0 for the wall. One pass for all: a tree has hundreds of openings.
std::vector<Moment> patch_moments(const Surface& surface) {
    std::vector<Moment> moments(surface.patches.size());
    const auto triangles = surface.triangles();
    const Positions& x = surface.points();
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        const std::uint16_t label = (*surface.patch_labels)[t];
        if (surface.patches[label].kind == PatchKind::Wall) continue;
        const double area = 0.5 * area_normal(x, triangles[t]).norm();
        const auto& [a, b, c] = triangles[t];
        moments[label].area += area;
        moments[label].of_area += area * (x[a] + x[b] + x[c]) / 3.0;
    }
    return moments;
}

/// Area of the vessel's section at an opening that may lie obliquely [mm^2]: a cut at 43 degrees is
/// a third larger. What the axis does not tell for certain changes nothing.
double area_across(const Surface& surface, std::size_t patch, double area) {
    constexpr double kCertain = 2.0;  // standard deviations
    constexpr double kMostTilt = 60.0;
    const auto axis = axis_at_patch(surface, patch);
    if (!axis) return area;
    const double tilt = std::clamp(axis->tilt_deg - kCertain * axis->doubt_deg, 0.0, kMostTilt);
    return area * std::cos(tilt * std::numbers::pi / 180.0);
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

/// True for a name that an inlet cannot keep, since it says or said another role or number. Files
/// keep names only: an inlet called outlet_left would be an outlet again.
bool is_outdated(const std::string& name) {
    const std::string stem = "inlet";
    const bool numbered =
        name.starts_with(stem + "_") &&
        name.find_first_not_of("0123456789", stem.size() + 1) == std::string::npos;
    return name == stem || numbered || name.starts_with("outlet");
}

/// Gives the openings of a surface their roles and names.
class Namer {
public:
    Namer(const Surface& surface, const std::vector<std::string>& unnamed)
        : surface_(surface), patches_(surface.patches), areas_(patch_areas(surface)) {
        for (std::size_t p = 1; p < patches_.size(); ++p)
            if (patches_[p].kind == PatchKind::Cut &&
                std::ranges::count(unnamed, patches_[p].name) > 0)
                open_.push_back(p);
        sort_by_area(open_);
    }

    /// The openings near some points are the inlets, and no others.
    void make_inlets(std::span<const Vec3> points) {
        std::vector<std::size_t> chosen;
        for (const Vec3& point : points)
            if (const auto p = nearest_opening(surface_, point);
                p && std::ranges::count(chosen, *p) == 0)
                chosen.push_back(*p);
        for (std::size_t p = 1; p < patches_.size(); ++p)
            if (patches_[p].kind == PatchKind::Inlet && std::ranges::count(chosen, p) == 0)
                make_outlet(p);
        sort_by_area(chosen);
        for (const std::size_t p : chosen)
            if (std::erase(open_, p) > 0 || is_outdated(patches_[p].name)) patches_[p].name = "";
        const int first = chosen.size() > 1 ? 1 : 0;
        for (const std::size_t p : chosen) make_inlet(p, first);
    }

    /// The opening of the widest vessel is the inlet, if it has no name yet or is to be promoted.
    void find_inlet(bool promote) {
        if (areas_.size() < 2 || std::ranges::count(patches_, PatchKind::Inlet, &Patch::kind) > 0)
            return;
        std::vector<std::size_t> openings(areas_.size() - 1);
        std::iota(openings.begin(), openings.end(), std::size_t{1});
        const std::size_t p = widest(openings);
        if (!open_.empty() && (promote || std::ranges::count(open_, p) > 0)) {
            const std::size_t inlet = widest(open_);
            patches_[inlet].name = "";
            make_inlet(inlet, 0);
            std::erase(open_, inlet);
        } else if (open_.empty() && promote && patches_[p].kind == PatchKind::Outlet) {
            if (is_outdated(patches_[p].name)) patches_[p].name = "";
            make_inlet(p, 0);
        }
    }

    [[nodiscard]] Surface named(bool gathers) {
        const int first = gathers && open_.size() == 1 ? 0 : 1;
        for (const std::size_t p : open_)
            patches_[p] = {free_patch_name("outlet", first, patches_), PatchKind::Outlet};
        return ordered(surface_, patches_, areas_);
    }

private:
    void sort_by_area(std::vector<std::size_t>& list) const {
        std::ranges::stable_sort(list, std::greater{}, [&](std::size_t p) { return areas_[p]; });
    }

    /// The one whose vessel has the largest section. Those of less than half the largest area would
    /// have to be oblique by more than 60 degrees.
    [[nodiscard]] std::size_t widest(const std::vector<std::size_t>& openings) const {
        double largest = 0.0, most = -1.0;
        for (const std::size_t p : openings) largest = std::max(largest, areas_[p]);
        std::size_t found = openings.front();
        for (const std::size_t p : openings) {
            if (areas_[p] < 0.5 * largest) continue;
            const double across = area_across(surface_, p, areas_[p]);
            if (across > most) found = p;
            most = std::max(most, across);
        }
        return found;
    }

    void make_inlet(std::size_t p, int first) {
        patches_[p].kind = PatchKind::Inlet;
        if (patches_[p].name.empty()) patches_[p].name = free_patch_name("inlet", first, patches_);
    }

    void make_outlet(std::size_t p) {
        patches_[p].kind = PatchKind::Outlet;
        if (patches_[p].name.starts_with("inlet"))
            patches_[p].name = free_patch_name("outlet", 1, patches_);
    }

    const Surface& surface_;
    std::vector<Patch> patches_;
    std::vector<double> areas_;      ///< by patch [mm^2]
    std::vector<std::size_t> open_;  ///< patches without a role, largest first
};

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
                      const InletChoice& choice) {
    Namer namer(surface, unnamed);
    if (choice.points.empty())
        namer.find_inlet(choice.promote);
    else
        namer.make_inlets(choice.points);
    return namer.named(choice.gathers);
}

std::vector<std::size_t> likely_inlets(const Surface& surface) {
    constexpr double kLeastWidth = 0.6, kLargestAngleDeg = 60.0;
    const auto& patches = surface.patches;
    std::vector<std::size_t> likely;
    if (std::ranges::count(patches, PatchKind::Inlet, &Patch::kind) != 1) return likely;
    const auto inlet = static_cast<std::size_t>(
        std::ranges::find(patches, PatchKind::Inlet, &Patch::kind) - patches.begin());
    const PatchShape main = patch_shape(surface, inlet);
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (patches[p].kind != PatchKind::Outlet) continue;
        const PatchShape shape = patch_shape(surface, p);
        if (shape.diameter() >= kLeastWidth * main.diameter() &&
            angle_deg(shape.plane.normal, main.plane.normal) <= kLargestAngleDeg)
            likely.push_back(p);
    }
    return likely;
}

std::optional<std::size_t> nearest_opening(const Surface& surface, const Vec3& point) {
    std::optional<std::size_t> best;
    double nearest = std::numeric_limits<double>::infinity();
    const std::vector<Moment> moments = patch_moments(surface);
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        if (surface.patches[p].kind == PatchKind::Wall || !(moments[p].area > 0.0)) continue;
        const double d = (moments[p].of_area / moments[p].area - point).norm();
        if (d < nearest) {
            nearest = d;
            best = p;
        }
    }
    return best;
}

}  // namespace vesselbench
