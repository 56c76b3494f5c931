#include "workbench/operations/shared/bodies.h"

#include <algorithm>
#include <optional>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/repair/body_shape.h"
#include "meshing/stamp/unite_bodies.h"

namespace vesselbench {

namespace {

constexpr const char* kLargest = "largest";
constexpr const char* kAsk = "ask";
constexpr const char* kVessel = "vessel";
constexpr const char* kAll = "all";

/// Of the whole area [-]; smaller parts are strays, not bodies.
constexpr double kCrumb = 0.01;
constexpr std::size_t kMostParts = 1000;  ///< more are noise

struct Body {
    std::uint32_t part = 0;
    BodyShape shape;
};

bool is_closed(const Surface& surface) {
    return surface.topology->boundary_loops().empty() && manifold_defects(*surface.topology).none();
}

std::vector<double> part_areas(const Surface& surface, const Components& parts) {
    std::vector<double> areas(parts.count(), 0.0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        areas[parts.of_triangle[t]] += triangle_area(surface.points(), surface.triangles()[t]);
    return areas;
}

Surface selected(const Surface& surface, const Components& parts, const std::vector<bool>& chosen) {
    std::vector<bool> keep(surface.triangle_count());
    for (TriangleId t = 0; t < keep.size(); ++t) keep[t] = chosen[parts.of_triangle[t]];
    return select_triangles(surface, keep);
}

/// The closed parts that are no crumbs.
std::vector<Body> bodies_of(const Surface& surface, const Components& parts) {
    const std::vector<double> areas = part_areas(surface, parts);
    double whole = 0.0;
    for (const double its : areas) whole += its;
    std::vector<Body> bodies;
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
        if (areas[part] < kCrumb * whole) continue;
        std::vector<bool> chosen(parts.count(), false);
        chosen[part] = true;
        const Surface body = selected(surface, parts, chosen);
        if (is_closed(body)) bodies.push_back({part, body_shape(body)});
    }
    return bodies;
}

class Settler {
public:
    Settler(const Surface& surface, const Components& parts, const Progress& progress)
        : surface_(surface),
          parts_(parts),
          progress_(progress),
          bodies_(bodies_of(surface, parts)) {
        crossing_ = crossing_bodies(surface, parts, progress.part(0.0, 0.5));
        std::erase_if(crossing_, [&](const BodyPair& pair) {
            return body(pair.first) == nullptr || body(pair.second) == nullptr;
        });
    }

    [[nodiscard]] SettledBodies settled(const std::string& choice) const {
        const bool any_vessel =
            std::ranges::any_of(bodies_, [](const Body& b) { return b.shape.may_be_vessel(); });
        if (choice == kAll || !any_vessel) return united(crossing_, surface_, parts_);
        const std::vector<const Body*> others = no_vessels();
        if (choice == kAsk && !others.empty()) ask(*others.front());
        std::vector<bool> keep(parts_.count(), true);
        for (const Body* other : others) keep[other->part] = false;
        if (others.empty()) return united(crossing_, surface_, parts_);
        const Surface rest = selected(surface_, parts_, keep);
        const Components parts = connected_components(*rest.topology);
        SettledBodies result = united(crossing_bodies_among_rest(keep), rest, parts);
        result.no_vessels = others.size();
        result.warnings.push_back({.code = "bodies-left-out",
                                   .place = others.front()->shape.centre,
                                   .figures = {{"bodies", static_cast<double>(others.size())}},
                                   .remedies = {{.arguments = {{"bodies", kAll}}}}});
        return result;
    }

private:
    [[nodiscard]] const Body* body(std::uint32_t part) const {
        const auto found = std::ranges::find(bodies_, part, &Body::part);
        return found == bodies_.end() ? nullptr : &*found;
    }

    /// Those that cannot be one, and cross a vessel or are larger than each: the largest first.
    [[nodiscard]] std::vector<const Body*> no_vessels() const {
        double largest = 0.0;
        for (const Body& b : bodies_)
            if (b.shape.may_be_vessel()) largest = std::max(largest, b.shape.area);
        std::vector<const Body*> found;
        for (const Body& b : bodies_)
            if (!b.shape.may_be_vessel() && (b.shape.area > largest || crosses_another(b.part)))
                found.push_back(&b);
        std::ranges::stable_sort(
            found, [](const Body* a, const Body* b) { return a->shape.area > b->shape.area; });
        return found;
    }

    [[nodiscard]] bool crosses_another(std::uint32_t part) const {
        return std::ranges::any_of(crossing_, [&](const BodyPair& pair) {
            return pair.first == part || pair.second == part;
        });
    }

    [[noreturn]] static void ask(const Body& other) {
        throw DiagnosedUsage({.code = "body-no-vessel",
                              .operation = "repair",
                              .place = other.shape.centre,
                              .figures = {{"x_mm", other.shape.size.x()},
                                          {"y_mm", other.shape.size.y()},
                                          {"z_mm", other.shape.size.z()}},
                              .remedies = {{.arguments = {{"bodies", kVessel}}},
                                           {.arguments = {{"bodies", kAll}}}}});
    }

    /// Parts are numbered by their first triangle, also where some of them are gone.
    [[nodiscard]] std::vector<BodyPair> crossing_bodies_among_rest(
        const std::vector<bool>& keep) const {
        std::vector<std::uint32_t> number(keep.size(), 0);
        for (std::size_t part = 1; part < keep.size(); ++part)
            number[part] = number[part - 1] + (keep[part - 1] ? 1U : 0U);
        std::vector<BodyPair> pairs;
        for (const auto& [a, b] : crossing_)
            if (keep[a] && keep[b]) pairs.emplace_back(number[a], number[b]);
        return pairs;
    }

    [[nodiscard]] SettledBodies united(const std::vector<BodyPair>& crossing,
                                       const Surface& surface, const Components& parts) const {
        UnitedBodies all = united_bodies(surface, parts, crossing, progress_.part(0.5, 1.0));
        SettledBodies result{.surface = std::move(all.surface), .united = all.bodies - all.made};
        if (all.bodies > 0)
            result.warnings.push_back({.code = "bodies-united",
                                       .figures = {{"bodies", static_cast<double>(all.bodies)}},
                                       .remedies = {{.arguments = {{"bodies", kLargest}}}}});
        return result;
    }

    const Surface& surface_;
    const Components& parts_;
    Progress progress_;
    std::vector<Body> bodies_;
    std::vector<BodyPair> crossing_;  ///< of bodies
};

}  // namespace

Parameter bodies_parameter() {
    return {.name = "bodies",
            .type = ParameterType::Choice,
            .default_value = std::string(kLargest),
            .help =
                "closed bodies of a surface from a file; largest: the others are unconnected "
                "pieces; vessel: bodies that overlap are united, and those that cannot be a "
                "vessel, such as a base plate, are left out; ask: the same, but such a body "
                "is asked about; all: bodies that overlap are united, whatever they are",
            .choices = {kLargest, kAsk, kVessel, kAll}};
}

SettledBodies settled_bodies(const Scene& scene, const std::string& choice,
                             const Progress& progress) {
    const Surface& surface = surface_of(scene);
    if (choice == kLargest || surface.empty() || scene.image) return {.surface = surface};
    const Components parts = connected_components(*surface.topology);
    if (parts.count() < 2 || parts.count() > kMostParts) return {.surface = surface};
    return Settler(surface, parts, progress).settled(choice);
}

}  // namespace vesselbench
