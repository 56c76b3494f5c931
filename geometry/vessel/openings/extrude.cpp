#include "geometry/vessel/openings/extrude.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/editing/rims.h"
#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/collision.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/patch_rim.h"
#include "geometry/vessel/openings/profile.h"

namespace vesselbench {

namespace {

/// Free space to keep, as fractions of the diameter in front and of the radius at the sides.
constexpr double kFreeInFront = 0.25;
constexpr double kFreeAtSides = 0.1;
constexpr double kLeastDiameters = 0.5;
constexpr double kLargestFlatness = 0.01;  // of the diameter
constexpr std::size_t kFewestCorners = 12;
constexpr double kMostExtents = 100.0;  // of the surface, as long as a tube may be
constexpr double kMostTriangles = 4e6;  // of a tube: more would only fill the memory
constexpr double kSteepest = 0.5;       // cosine between direction and normal
constexpr double kLayersPerEdge = 2.0 / std::numbers::sqrt3;  // near-equilateral triangles

/// The way of a cap's centre for 1 mm of height above the cap.
Vec3 rise_of(const Plane& plane, const ExtrusionParameters& parameters) {
    const Vec3 direction = parameters.direction.value_or(plane.normal).stableNormalized();
    const double share = direction.dot(plane.normal);
    if (!(share >= kSteepest))
        throw InvalidInput(
            "an extrusion's direction must be at most 60 degrees from the cap's normal");
    return direction / share;
}

/// The tube to be added: rings with equal numbers of points, each ring turned by half a step.
/// Heights are above the cap; the parameters' length is a height, too.
class AddedTube {
public:
    AddedTube(const ClosedProfile& profile, const Plane& plane,
              const ExtrusionParameters& parameters)
        : profile_(profile),
          plane_(plane),
          parameters_(parameters),
          area_(profile.area()),
          centre_(profile.centroid()),
          rise_(rise_of(plane, parameters)),
          edge_(profile.perimeter() / static_cast<double>(profile.shares().size())),
          corners_(std::max(kFewestCorners, profile.shares().size())) {}

    double edge() const { return edge_; }

    double diameter() const { return 2.0 * std::sqrt(area_ / std::numbers::pi); }

    Vec3 centre(double z) const { return centre_ + z * rise_; }

    int layers(double length) const {
        return std::max(1, static_cast<int>(std::lround(length / edge_ * kLayersPerEdge)));
    }

    /// Length of a tube of so many triangles [mm].
    double length_of(double triangles) const {
        return triangles / (2.0 * static_cast<double>(corners_)) * edge_ / kLayersPerEdge;
    }

    /// Fractions of the perimeter of the k-th ring's points; ring 0 is the rim itself.
    std::vector<double> shares(int ring) const {
        if (ring == 0) return profile_.shares();
        std::vector<double> result;
        for (std::size_t i = 0; i < corners_; ++i)
            result.push_back((static_cast<double>(i) + (ring % 2 == 0 ? 0.0 : 0.5)) /
                             static_cast<double>(corners_));
        return result;
    }

    /// Points of a ring at height z [mm], scaled to the cap's area times `area_factor`.
    Positions ring(const std::vector<double>& shares, double z, double area_factor = 1.0) const {
        const double weight = circle_weight(z);
        const double radius = std::sqrt(area_ / std::numbers::pi);
        Positions points;
        for (const double share : shares) {
            Vec3 p = profile_.at(share);
            if (weight > 0.0) p = (1.0 - weight) * p + weight * profile_.on_circle(share, radius);
            points.push_back(plane_.projected(p));
        }
        const auto [area, centroid] = polygon_area(points, plane_.normal);
        const double scale = std::sqrt(area_factor * area_ / area);
        for (Vec3& p : points) p = centre(z) + scale * (p - centroid);
        return points;
    }

private:
    double circle_weight(double z) const {
        if (parameters_.profile == ExtrusionProfile::Keep) return 0.0;
        const double t = std::clamp(z / (parameters_.blend * parameters_.length), 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    }

    const ClosedProfile& profile_;
    Plane plane_;
    ExtrusionParameters parameters_;
    double area_;
    Vec3 centre_;
    Vec3 rise_;
    double edge_;
    std::size_t corners_;
};

/// Triangles that the tube would need free, layer by layer.
struct Probes {
    std::vector<Corners> triangles;
    std::vector<int> layers;  ///< from 1, of each triangle
};

/// \param margins fraction of the free space (kFreeInFront, kFreeAtSides) to keep, 0 or 1
Probes probes_of(const AddedTube& tube, int layers, double layer_height, double margins) {
    const auto shares = tube.shares(2);
    const std::vector<Triangle> band = band_between(shares, shares);
    Probes probes;
    Positions lower;
    for (int k = 1; k <= layers; ++k) {
        const double z = k * layer_height;
        const double grown = margins * std::min(1.0, z / tube.diameter()) * kFreeAtSides;
        const Positions upper = tube.ring(shares, z, (1.0 + grown) * (1.0 + grown));
        const auto at = [&](VertexId v) {
            return v < shares.size() ? lower[v] : upper[v - shares.size()];
        };
        if (!lower.empty())
            for (const Triangle& t : band)
                probes.triangles.push_back({at(t[0]), at(t[1]), at(t[2])});
        // A fan across the opening finds anything that would be inside the tube.
        const Vec3 middle = tube.centre(z);
        for (std::size_t i = 0; i < upper.size(); ++i)
            probes.triangles.push_back({middle, upper[i], upper[(i + 1) % upper.size()]});
        probes.layers.resize(probes.triangles.size(), k);
        lower = upper;
    }
    return probes;
}

/// Length that is free in front of the opening [mm].
/// \param margins as in probes_of
double free_length(const Surface& without_cap, const AddedTube& tube, double wanted,
                   double margins) {
    const double in_front = margins * kFreeInFront * tube.diameter();
    const double end = wanted + in_front;
    const int layers = tube.layers(end);
    const double dz = end / layers;
    const Probes probes = probes_of(tube, layers, dz, margins);
    const auto hits = touching(without_cap, probes.triangles);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i]) return (probes.layers[i] - 1) * dz - in_front;
    return wanted;
}

void check(const Surface& surface, std::size_t patch, const PatchShape& shape,
           const ExtrusionParameters& parameters) {
    if (!(parameters.length > 0.0) || !(parameters.blend > 0.0) || parameters.blend > 1.0)
        throw InvalidInput("an extrusion needs a length above 0 mm and a blend in (0, 1]");
    if (surface.patches[patch].kind == PatchKind::Wall)
        throw InvalidInput("the patch '" + surface.patches[patch].name +
                           "' is wall: only a cap can be extruded");
    if (shape.flatness > kLargestFlatness * shape.diameter())
        throw DiagnosedFailure(
            {.code = "cap-not-flat",
             .operation = "extrude-opening",
             .place = shape.plane.point,
             .words = {{"cap", surface.patches[patch].name}},
             .remedies = {{.operation = "clip-opening",
                           .arguments = {{"tip", coordinates_argument(shape.plane.point)}}}}});
}

class Extruder {
public:
    Extruder(const Surface& surface, std::size_t patch, const PatchRim& rim)
        : surface_(surface), rim_(rim), label_(static_cast<std::uint16_t>(patch)) {
        for (TriangleId t = 0; t < surface.triangle_count(); ++t)
            if ((*surface.patch_labels)[t] == patch) surface_.remove(t);
    }

    Surface without_cap() const { return surface_.to_surface(); }

    Surface with_tube(const AddedTube& tube, const ClosedProfile& profile, const Plane& plane,
                      double length) {
        const int layers = tube.layers(length);
        Ring lower{rim_.loop, tube.shares(0)};
        for (int k = 1; k <= layers; ++k) {
            Ring upper{{}, tube.shares(k)};
            const Positions points = tube.ring(upper.shares, length * k / layers);
            for (std::size_t i = 0; i < points.size(); ++i)
                upper.vertices.push_back(add_vertex(points[i], profile.segment(upper.shares[i])));
            join_rings(surface_, lower, upper, rim_.wall_label);
            lower = std::move(upper);
        }
        close_flat(surface_, lower.vertices, {plane.point + length * plane.normal, plane.normal},
                   tube.edge(), label_);
        return surface_.to_surface();
    }

private:
    /// Attributes come from the rim: from its corner and how far the point is on the way to the
    /// next one.
    VertexId add_vertex(const Vec3& point, const std::pair<std::size_t, double>& place) {
        const auto& [corner, t] = place;
        const VertexId sources[] = {rim_.loop[corner], rim_.loop[(corner + 1) % rim_.loop.size()]};
        const double weights[] = {1.0 - t, t};
        return surface_.add_vertex(point, sources, weights);
    }

    EditableSurface surface_;
    const PatchRim& rim_;
    std::uint16_t label_;
};

}  // namespace

Extrusion extrude_opening(const Surface& surface, std::size_t patch,
                          const ExtrusionParameters& parameters) {
    const PatchShape shape = patch_shape(surface, patch);
    check(surface, patch, shape, parameters);
    require_in_proportion("length", parameters.length, surface, kMostExtents);
    const PatchRim rim = patch_rim(surface, patch);
    Positions corners;
    for (const VertexId v : rim.loop) corners.push_back(shape.plane.projected(surface.points()[v]));
    const ClosedProfile profile(corners, shape.plane);
    Extruder extruder(surface, patch, rim);
    const double way = rise_of(shape.plane, parameters).norm(), height = parameters.length / way;
    ExtrusionParameters used = parameters;
    used.length = height;
    const AddedTube wanted(profile, shape.plane, used);
    if (const double most = way * wanted.length_of(kMostTriangles); parameters.length > most)
        throw DiagnosedFailure(
            {.code = "extrusion-too-long",
             .operation = "extrude-opening",
             .place = shape.plane.point,
             .figures = {{"length_mm", parameters.length}, {"most_millions", kMostTriangles / 1e6}},
             .words = {{"opening", surface.patches[patch].name}},
             .remedies = {{.arguments = {{"length", formatted(most)}}}}});
    const Surface rest = extruder.without_cap();
    if (parameters.may_shorten)
        used.length = std::min(height, free_length(rest, wanted, height, 1.0));
    const AddedTube tube(profile, shape.plane, used);
    if (used.length < std::min(height, kLeastDiameters * shape.diameter()) ||
        free_length(rest, tube, used.length, 0.0) < used.length)
        return {surface, 0.0, true};
    const bool shortened = used.length < height;
    return {extruder.with_tube(tube, profile, shape.plane, used.length),
            shortened ? used.length * way : parameters.length, shortened};
}

}  // namespace vesselbench
