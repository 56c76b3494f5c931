#include "workbench/review/page_models.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/vertex_normals.h"
#include "workbench/review/known_operation.h"
#include "workbench/review/page_slices.h"
#include "workbench/review/page_thumbnail.h"

namespace vesselbench {

namespace {

/// Fractions of the progress: all results are read, and all models are compared.
constexpr double kReadingShare = 0.1, kComparingShare = 0.9;

/// A vertex that is nearer to the surface before has not moved [mm].
constexpr double kUnmoved = 1e-4;

/// A surface among those of the page.
struct ShownSurface {
    Surface surface;
    PageGeometry::State state;
};

/// The points of another surface that are closest to a surface's vertices; at distance 0 for those
/// that the two share.
std::vector<SurfacePoint> closest_points(const ShownSurface& of, const ShownSurface& from) {
    std::vector<std::size_t> own;
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < of.state.vertices.size(); ++v) {
        if (std::ranges::binary_search(from.state.used, of.state.vertices[v])) continue;
        own.push_back(v);
        points.push_back(of.surface.points()[v]);
    }
    const std::vector<SurfacePoint> found = distance_to(from.surface).closest_points(points);
    std::vector<SurfacePoint> closest(of.surface.vertex_count(), SurfacePoint{.distance = 0.0});
    for (std::size_t i = 0; i < own.size(); ++i) closest[own[i]] = found[i];
    return closest;
}

double magnitude(double value) {
    return std::abs(value);
}

void add_moved(const Surface& surface, const std::vector<double>& values, Positions& moved) {
    for (std::size_t v = 0; v < values.size(); ++v)
        if (magnitude(values[v]) > kUnmoved) moved.push_back(surface.points()[v]);
}

/// Of the largest deviation, unless an earlier one is larger.
void take_largest(const Surface& surface, const std::vector<double>& values, PageEditModel& model) {
    const auto largest = std::ranges::max_element(values, {}, magnitude);
    if (largest == values.end() || magnitude(*largest) <= std::max(model.largest, kUnmoved)) return;
    const auto vertex = static_cast<std::size_t>(largest - values.begin());
    model.largest = magnitude(*largest);
    model.place = surface.points()[vertex];
    model.outward = (*vertex_normals_of(surface))[vertex];
}

/// What was added is seen on the surface after the edit, what was lost on the one before it.
/// \return signed_distances() of the surface after from the one before; empty: nothing has changed
std::vector<double> add_difference(PageGeometry& geometry, const ShownSurface& before,
                                   const ShownSurface& after, PageEditModel& model) {
    const std::vector<SurfacePoint> behind = closest_points(after, before),
                                    ahead = closest_points(before, after);
    const std::vector<double> gained = signed_distances(after.surface, distance_to(before.surface),
                                                        behind),
                              lost = signed_distances(before.surface, distance_to(after.surface),
                                                      ahead);
    Positions moved;
    add_moved(after.surface, gained, moved);
    add_moved(before.surface, lost, moved);
    if (moved.empty()) return {};
    model.changed = bounds(moved);
    model.deviation = geometry.add_values(after.state, gained);
    model.deviation["measure"] = "distance from the surface before the edit";
    take_largest(after.surface, gained, model);
    take_largest(before.surface, lost, model);
    if (model.place)
        model.radius = radius_near(before.surface, distance_to(before.surface), *model.place);
    model.wall = wall_change(
        before.surface, wall_deviations(before.surface, after.surface, ahead, lost), after.surface,
        wall_deviations(after.surface, before.surface, behind, gained), kUnmoved);
    return gained;
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
        progress.report(static_cast<double>(shown.size()) / static_cast<double>(log.size()),
                        "reading the edits' results");
        if (entry.status != EditStatus::Done || !entry.result) continue;
        const Scene scene = session.result_scene(entry.result->id, progress.silent());
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

PageModels page_models(Session& session, const std::vector<LogEntry>& log,
                       const OperationLookup& find, const PageContents& contents,
                       Progress progress) {
    Scene last;
    const std::vector<ShownEdit> shown =
        surfaces_of(session, log, last, progress.part(0.0, kReadingShare));
    const auto& neighbours = last.neighbours;
    PageModels models{
        .geometry = PageGeometry(box_of(shown, neighbours)), .edits = {}, .neighbours = {}};
    std::optional<ShownSurface> before;
    const Progress comparing = progress.part(kReadingShare, kComparingShare);
    for (const ShownEdit& edit : shown) {
        comparing.report(
            static_cast<double>(models.edits.size()) / static_cast<double>(shown.size()),
            "comparing the models before and after the edits");
        PageEditModel& model = models.edits[edit.id];
        ShownSurface after{edit.surface, models.geometry.add(edit.surface)};
        if (before) model.before = before->state.number;
        model.after = after.state.number;
        std::vector<double> gained;
        if (before) gained = add_difference(models.geometry, *before, after, model);
        if (contents.thumbnails)
            model.thumbnail = thumbnail_png(after.surface, gained, model.outward);
        before = std::move(after);
    }
    if (contents.images == PageImages::Slices && last.image) add_slices(*last.image, models);
    for (const auto& [name, surface] : neighbours)
        models.neighbours.emplace_back(name, models.geometry.add(surface).number);
    for (const LogEntry& entry : log)
        if (const Operation* operation = known_operation(find, entry.edit.operation))
            if (auto others =
                    other_choices(session, entry, *operation, progress.part(kComparingShare, 1.0));
                !others.empty())
                models.edits[entry.edit.edit.id].others = std::move(others);
    return models;
}

}  // namespace vesselbench
