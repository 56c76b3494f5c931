#include "workbench/review/page_models.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/vertex_normals.h"
#include "workbench/review/page_slices.h"
#include "workbench/review/page_thumbnail.h"

namespace vesselbench {

namespace {

/// Rays that measure a vessel start so far below its wall [mm].
constexpr double kBelowWall = 1e-4;
/// A vertex that is nearer to the surface before has not moved [mm].
constexpr double kUnmoved = 1e-4;

/// Half the way to the opposite wall.
std::optional<double> radius_at(const SurfaceDistance& surface, const Vec3& place,
                                const Vec3& outward) {
    const auto hit = surface.first_hit(place - kBelowWall * outward, -outward);
    if (!hit || hit->distance <= 0.0) return std::nullopt;
    return hit->distance / 2;
}

/// A surface among those of the page.
struct ShownSurface {
    Surface surface;
    PageGeometry::State state;
};

/// Distances of a surface's vertices from another one; 0 for those that the two share.
std::vector<double> deviations(const ShownSurface& of, const ShownSurface& from) {
    std::vector<std::size_t> own;
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < of.state.vertices.size(); ++v) {
        if (std::ranges::binary_search(from.state.used, of.state.vertices[v])) continue;
        own.push_back(v);
        points.push_back(of.surface.points()[v]);
    }
    const std::vector<SurfacePoint> closest = distance_to(from.surface).closest_points(points);
    std::vector<double> values(of.surface.vertex_count(), 0.0);
    for (std::size_t i = 0; i < own.size(); ++i) values[own[i]] = closest[i].distance;
    return values;
}

void add_moved(const Surface& surface, const std::vector<double>& values, Positions& moved) {
    for (std::size_t v = 0; v < values.size(); ++v)
        if (values[v] > kUnmoved) moved.push_back(surface.points()[v]);
}

/// Of the largest deviation, unless an earlier one is larger.
void take_largest(const Surface& surface, const std::vector<double>& values, PageEditModel& model) {
    const auto largest = std::ranges::max_element(values);
    if (largest == values.end() || *largest <= std::max(model.largest, kUnmoved)) return;
    const auto vertex = static_cast<std::size_t>(largest - values.begin());
    model.largest = *largest;
    model.place = surface.points()[vertex];
    model.outward = (*vertex_normals_of(surface))[vertex];
}

std::optional<double> radius_near(const Surface& surface, const Vec3& place) {
    const SurfaceDistance distance = distance_to(surface);
    const SurfacePoint wall = distance.closest_point(place);
    const Vec3 outward = area_normal(surface.points(), surface.triangles()[wall.triangle]);
    if (outward.isZero()) return std::nullopt;
    return radius_at(distance, wall.point, outward.normalized());
}

/// What was added is in another colour; seen from where most has changed.
void draw_thumbnail(const Surface& surface, std::span<const double> gained, PageEditModel& model) {
    model.thumbnail = thumbnail_png(surface, gained, model.outward);
}

/// What was added is seen on the surface after the edit, what was lost on the one before it.
void add_difference(PageGeometry& geometry, const ShownSurface& before, const ShownSurface& after,
                    PageEditModel& model) {
    const std::vector<double> gained = deviations(after, before), lost = deviations(before, after);
    Positions moved;
    add_moved(after.surface, gained, moved);
    add_moved(before.surface, lost, moved);
    if (moved.empty()) return draw_thumbnail(after.surface, {}, model);
    model.changed = bounds(moved);
    model.deviation = geometry.add_values(after.state, gained);
    model.deviation["measure"] = "distance from the surface before the edit";
    take_largest(after.surface, gained, model);
    take_largest(before.surface, lost, model);
    if (model.place) model.radius = radius_near(before.surface, *model.place);
    draw_thumbnail(after.surface, gained, model);
}

/// Edits that have a surface, with it, in order.
struct ShownEdit {
    EditId id;
    Surface surface;
};

/// \param last receives what later edits leave as it is: neighbours and image
std::vector<ShownEdit> surfaces_of(Session& session, const std::vector<LogEntry>& log, Scene& last,
                                   const Progress& progress) {
    std::vector<ShownEdit> shown;
    for (const LogEntry& entry : log) {
        if (entry.status != EditStatus::Done || !entry.result) continue;
        const Scene scene = session.result_scene(entry.result->id, progress);
        if (scene.surface && !scene.surface->empty())
            shown.push_back({entry.edit.edit.id, *scene.surface});
        last = scene;
    }
    return shown;
}

Bounds box_of(const std::vector<ShownEdit>& shown,
              const std::map<std::string, Surface>& neighbours) {
    Positions corners;
    const auto add = [&](const Surface& surface) {
        const Bounds box = bounds(surface);
        corners.push_back(box.min);
        corners.push_back(box.max);
    };
    for (const ShownEdit& edit : shown) add(edit.surface);
    for (const auto& [name, surface] : neighbours) add(surface);
    return bounds(corners);
}

/// A slice shows the vessel with its surroundings.
constexpr double kSliceRadii = 6.0, kLeastSlice = 15.0;  ///< to every side: in radii, at least [mm]

void add_slices(const Image& image, PageModels& models) {
    PageSlices slices(image);
    for (auto& [id, model] : models.edits)
        if (model.place)
            model.slices =
                slices.add(std::to_string(id), *model.place,
                           std::max(kSliceRadii * model.radius.value_or(0.0), kLeastSlice));
    models.slices = slices.blobs();
}

}  // namespace

PageModels page_models(Session& session, const std::vector<LogEntry>& log, PageImages images,
                       Progress progress) {
    Scene last;
    const std::vector<ShownEdit> shown = surfaces_of(session, log, last, progress);
    const auto& neighbours = last.neighbours;
    PageModels models{
        .geometry = PageGeometry(box_of(shown, neighbours)), .edits = {}, .neighbours = {}};
    std::optional<ShownSurface> before;
    for (const ShownEdit& edit : shown) {
        progress.check_cancelled();
        PageEditModel& model = models.edits[edit.id];
        ShownSurface after{edit.surface, models.geometry.add(edit.surface)};
        if (before) model.before = before->state.number;
        model.after = after.state.number;
        if (before)
            add_difference(models.geometry, *before, after, model);
        else
            draw_thumbnail(after.surface, {}, model);
        before = std::move(after);
    }
    if (images == PageImages::Slices && last.image) add_slices(*last.image, models);
    for (const auto& [name, surface] : neighbours)
        models.neighbours.emplace_back(name, models.geometry.add(surface).number);
    return models;
}

}  // namespace vesselbench
