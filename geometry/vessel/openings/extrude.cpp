#include "geometry/vessel/openings/extrude.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/collision.h"
#include "geometry/vessel/openings/flat_cap.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/patch_rim.h"
#include "geometry/vessel/openings/profile.h"
#include "geometry/vessel/openings/surface_parts.h"

namespace vesselbench {

namespace {

/// Free space that is kept, as shares of the diameter in front and of the radius to the sides.
constexpr double kFreeInFront = 0.25;
constexpr double kFreeAtSides = 0.1;
constexpr double kLeastDiameters = 0.5;
constexpr double kLargestFlatness = 0.01;  // of the diameter
constexpr std::size_t kFewestCorners = 12;
constexpr double kLayersPerEdge = 2.0 / std::numbers::sqrt3;  // near-equilateral triangles

/// The tube that is added: rings of equally many points, each ring turned by half a step.
class Tube {
public:
    Tube(const ClosedProfile& profile, const Plane& plane, const ExtrusionParameters& parameters)
        : profile_(profile),
          plane_(plane),
          parameters_(parameters),
          area_(profile.area()),
          centre_(profile.centroid()),
          edge_(profile.perimeter() / static_cast<double>(profile.shares().size())),
          corners_(std::max(kFewestCorners, profile.shares().size())) {}

    double edge() const { return edge_; }

    double diameter() const { return 2.0 * std::sqrt(area_ / std::numbers::pi); }

    Vec3 centre(double z) const { return centre_ + z * plane_.normal; }

    int layers(double length) const {
        return std::max(1, static_cast<int>(std::lround(length / edge_ * kLayersPerEdge)));
    }

    /// Shares of the perimeter of the k-th ring's points; ring 0 is the rim itself.
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
        for (Vec3& p : points) p = centre_ + scale * (p - centroid) + z * plane_.normal;
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
    double edge_;
    std::size_t corners_;
};

/// Triangles between two rings, by the order of their points' shares; indices of the lower ring,
/// then those of the upper one. Outward when the rings run counter-clockwise and the upper one lies
/// on the normal's side.
std::vector<Triangle> zip(const std::vector<double>& lower, const std::vector<double>& upper) {
    std::vector<Triangle> triangles;
    const auto n = static_cast<VertexId>(lower.size()), m = static_cast<VertexId>(upper.size());
    const auto share = [](const std::vector<double>& shares, VertexId i) {
        const auto size = static_cast<VertexId>(shares.size());
        return shares[i % size] + (i >= size ? 1.0 : 0.0);
    };
    for (VertexId i = 0, j = 0; i < n || j < m;) {
        const VertexId a = i % n, b = n + j % m;
        // Advance on the ring the middle of whose next edge comes first.
        const bool below = j == m || (i < n && share(lower, i + 1) + share(lower, i) <
                                                   share(upper, j + 1) + share(upper, j));
        if (below)
            triangles.push_back({a, ++i % n, b});
        else
            triangles.push_back({a, n + ++j % m, b});
    }
    return triangles;
}

/// Length that is free in front of the opening [mm].
/// \param margins share of the free space (kFreeInFront, kFreeAtSides) that is wanted, 0 or 1
double free_length(const Surface& without_cap, const Tube& tube, double wanted, double margins) {
    const double in_front = margins * kFreeInFront * tube.diameter();
    const double end = wanted + in_front;
    const int layers = tube.layers(end);
    const double dz = end / layers;
    const auto shares = tube.shares(2);
    std::vector<Corners> probes;
    std::vector<int> layer_of;
    Positions lower;
    for (int k = 1; k <= layers; ++k) {
        const double grown = margins * std::min(1.0, k * dz / tube.diameter()) * kFreeAtSides;
        const Positions upper = tube.ring(shares, k * dz, (1.0 + grown) * (1.0 + grown));
        for (const Triangle& t : lower.empty() ? std::vector<Triangle>{} : zip(shares, shares)) {
            const auto at = [&](VertexId v) {
                return v < shares.size() ? lower[v] : upper[v - shares.size()];
            };
            probes.push_back({at(t[0]), at(t[1]), at(t[2])});
            layer_of.push_back(k);
        }
        // A fan across finds what would lie inside the tube.
        const Vec3 middle = tube.centre(k * dz);
        for (std::size_t i = 0; i < upper.size(); ++i) {
            probes.push_back({middle, upper[i], upper[(i + 1) % upper.size()]});
            layer_of.push_back(k);
        }
        lower = upper;
    }
    const auto hits = touching(without_cap, probes);
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i]) return (layer_of[i] - 1) * dz - in_front;
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
        throw AlgorithmFailure("the cap '" + surface.patches[patch].name +
                               "' is not flat: clip it first (clip-opening)");
}

class Extruder {
public:
    Extruder(const Surface& surface, std::size_t patch, const PatchRim& rim)
        : parts_(take_apart(surface)),
          rim_(rim),
          label_(static_cast<std::uint16_t>(patch)),
          removed_(surface.triangle_count(), 0) {
        for (TriangleId t = 0; t < surface.triangle_count(); ++t)
            if ((*surface.patch_labels)[t] == patch) removed_[t] = 1;
    }

    Surface without_cap() const { return put_together(parts_, removed_); }

    Surface with_tube(const Tube& tube, const ClosedProfile& profile, const Plane& plane,
                      double length) {
        const int layers = tube.layers(length);
        std::vector<VertexId> lower = rim_.loop;
        std::vector<double> lower_shares = tube.shares(0);
        Positions points;
        for (int k = 1; k <= layers; ++k) {
            const auto shares = tube.shares(k);
            points = tube.ring(shares, length * k / layers);
            std::vector<VertexId> upper;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto [corner, t] = profile.segment(shares[i]);
                const VertexId sources[] = {rim_.loop[corner],
                                            rim_.loop[(corner + 1) % rim_.loop.size()]};
                const double weights[] = {1.0 - t, t};
                upper.push_back(parts_.add_vertex(points[i], sources, weights));
            }
            add(zip(lower_shares, shares), lower, upper, rim_.wall_label);
            lower = std::move(upper);
            lower_shares = shares;
        }
        add_cap(points, {plane.point + length * plane.normal, plane.normal}, lower, tube.edge());
        removed_.resize(parts_.triangles.size(), 0);
        return put_together(parts_, removed_);
    }

private:
    void add(const std::vector<Triangle>& triangles, std::vector<VertexId> ids,
             const std::vector<VertexId>& more, std::uint16_t label) {
        ids.insert(ids.end(), more.begin(), more.end());
        for (const auto& [a, b, c] : triangles)
            parts_.add_triangle({ids[a], ids[b], ids[c]}, label);
    }

    void add_cap(const Positions& corners, const Plane& plane, const std::vector<VertexId>& ring,
                 double edge) {
        const FlatCap cap = fill_flat(corners, plane, edge);
        const std::vector<double> equal(ring.size(), 1.0 / static_cast<double>(ring.size()));
        std::vector<VertexId> inner;
        for (const Vec3& p : cap.inner) inner.push_back(parts_.add_vertex(p, ring, equal));
        add(cap.triangles, ring, inner, label_);
    }

    SurfaceParts parts_;
    const PatchRim& rim_;
    std::uint16_t label_;
    std::vector<std::uint8_t> removed_;
};

}  // namespace

Extrusion extrude_opening(const Surface& surface, std::size_t patch,
                          const ExtrusionParameters& parameters) {
    const PatchShape shape = patch_shape(surface, patch);
    check(surface, patch, shape, parameters);
    const PatchRim rim = patch_rim(surface, patch);
    Positions corners;
    for (const VertexId v : rim.loop) corners.push_back(shape.plane.projected(surface.points()[v]));
    const ClosedProfile profile(corners, shape.plane);
    Extruder extruder(surface, patch, rim);
    const Tube wanted(profile, shape.plane, parameters);
    const Surface rest = extruder.without_cap();
    ExtrusionParameters used = parameters;
    if (parameters.may_shorten)
        used.length =
            std::min(parameters.length, free_length(rest, wanted, parameters.length, 1.0));
    const Tube tube(profile, shape.plane, used);
    if (used.length < std::min(parameters.length, kLeastDiameters * shape.diameter()) ||
        free_length(rest, tube, used.length, 0.0) < used.length)
        throw AlgorithmFailure("the opening '" + surface.patches[patch].name + "' at " +
                               place_text(shape.plane.point) +
                               " cannot be extruded: another part of the surface is in its way; "
                               "clip it at another place, or leave it out");
    return {extruder.with_tube(tube, profile, shape.plane, used.length), used.length,
            used.length < parameters.length};
}

}  // namespace vesselbench
