#include "smoothing/brush/brush.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"

namespace vesselbench {

namespace {

/// By the brush's radius: how far a dab of strength 1 lifts its middle.
constexpr double kInflation = 0.1;

/// cos 60 degrees: how far the normal of a place may have turned.
constexpr double kSameSide = 0.5;

const Surface& checked(const Surface& surface) {
    if (surface.empty()) throw InvalidInput("the surface has no triangle to brush on");
    require_finite(surface.points());
    return surface;
}

std::vector<std::uint8_t> kept_vertices(const Surface& surface) {
    std::vector<std::uint8_t> kept = surface.topology->boundary_vertices();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) kept[v] = 1;
    return kept;
}

void check(const Dab& dab, BrushKind kind) {
    if (!dab.anchor.point.allFinite()) throw InvalidInput("the dab's point is not finite");
    if (!dab.anchor.normal.allFinite() || dab.anchor.normal.norm() == 0.0)
        throw InvalidInput("the dab's normal has no direction");
    require_positive("local radius", dab.anchor.radius);
    require_positive("radius", dab.radius);
    require_range("strength", dab.strength, kind == BrushKind::Smooth ? 0.0 : -1.0, 1.0);
    require_range("falloff", dab.falloff, 0.0, 1.0);
}

}  // namespace

Anchor nearest_anchor(const Surface& surface, const SurfaceDistance& places, const Vec3& point,
                      double otherwise) {
    if (!point.allFinite()) throw InvalidInput("the point to brush at is not finite");
    const SurfacePoint place = places.closest_point(point);
    const Vec3 normal = area_normal(surface.points(), surface.triangles()[place.triangle]);
    if (!(normal.norm() > 0.0))
        throw DiagnosedFailure({.code = "brush-on-degenerate",
                                .place = place.point,
                                .remedies = {{.operation = "repair"}}});
    Anchor anchor{.point = place.point, .normal = normal.normalized(), .radius = otherwise};
    const auto hits = places.all_hits(place.point, -anchor.normal);
    const Triangle& here = surface.triangles()[place.triangle];
    const auto touches = [&](TriangleId t) {
        return std::ranges::find_first_of(surface.triangles()[t], here) !=
               surface.triangles()[t].end();
    };
    const auto opposite = std::ranges::find_if(hits, [&](const SurfaceHit& hit) {
        return hit.from_inside && hit.distance > 0.0 && !touches(hit.triangle);
    });
    if (opposite != hits.end()) anchor.radius = 0.5 * opposite->distance;
    return anchor;
}

double falloff_share(const Dab& dab, double distance) {
    const double t = distance / dab.radius, solid = 1.0 - dab.falloff;
    if (t > 1.0) return 0.0;
    if (t <= solid) return 1.0;
    const double s = (t - solid) / dab.falloff;
    return (1.0 - s * s) * (1.0 - s * s);
}

BrushStroke::BrushStroke(Surface surface, BrushSettings settings,
                         std::shared_ptr<const SurfaceDistance> places)
    : start_(checked(surface)),
      settings_(std::move(settings)),
      places_(places ? std::move(places)
                     : std::make_shared<const SurfaceDistance>(distance_to(start_))),
      neighbourhood_(*start_.topology),
      fixed_(kept_vertices(start_)),
      now_(start_.points()) {
    require_range("passes", settings_.passes, 1, 100);
    if (settings_.kind != BrushKind::Weight) return;
    if (settings_.attribute.empty()) throw InvalidInput("attribute needs a name");
    const auto known = start_.attributes.find(settings_.attribute);
    weights_ =
        known == start_.attributes.end() ? std::vector<double>(now_.size(), 0.0) : *known->second;
}

SurfacePoint BrushStroke::resolve(const Anchor& anchor) const {
    const Vec3 normal = anchor.normal.normalized();
    SurfacePoint best;
    const auto try_triangle = [&](TriangleId t) {
        const auto& [a, b, c] = start_.triangles()[t];
        const Vec3 own = area_normal(now_, start_.triangles()[t]);
        if (!(own.dot(normal) >= kSameSide * own.norm()) || own.norm() == 0.0) return;
        const Vec3 point = closest_point_on_triangle(anchor.point, now_[a], now_[b], now_[c]);
        const double distance = (point - anchor.point).norm();
        const bool nearer =
            distance < best.distance || (distance == best.distance && t < best.triangle);
        if (distance <= anchor.radius && nearer) best = {point, t, distance};
    };
    // No vertex has moved farther than farthest_ from where the tree holds it.
    if (const auto near = places_->closest_point(anchor.point, anchor.radius + farthest_))
        try_triangle(near->triangle);
    const double reach = std::min(best.distance, anchor.radius) + farthest_;
    for (const TriangleId t : places_->triangles_within(anchor.point, reach)) try_triangle(t);
    if (best.distance <= anchor.radius) return best;
    throw DiagnosedFailure({.code = "dab-without-surface",
                            .place = anchor.point,
                            .figures = {{"radius_mm", anchor.radius}}});
}

std::vector<VertexId> BrushStroke::add(const Dab& dab) {
    check(dab, settings_.kind);
    const SurfacePoint place = resolve(dab.anchor);
    touched_.clear();
    for (const auto& [v, distance] :
         neighbourhood_.within(now_, place.triangle, place.point, dab.radius)) {
        const double share = dab.strength * falloff_share(dab, distance);
        const bool stays = settings_.kind != BrushKind::Weight && fixed_[v] != 0;
        if (share != 0.0 && !stays) touched_.push_back({v, share});
    }
    if (settings_.kind == BrushKind::Smooth) smooth();
    if (settings_.kind == BrushKind::Inflate) inflate(kInflation * dab.radius);
    if (settings_.kind == BrushKind::Weight) paint();
    std::vector<VertexId> changed;
    changed.reserve(touched_.size());
    for (const Touched& touched : touched_) {
        changed.push_back(touched.vertex);
        farthest_ =
            std::max(farthest_, (now_[touched.vertex] - start_.points()[touched.vertex]).norm());
    }
    return changed;
}

void BrushStroke::smooth() {
    const CompressedRows& rings = start_.topology->rings();
    moved_.resize(touched_.size());
    for (int pass = 0; pass < settings_.passes; ++pass) {
        for (std::size_t i = 0; i < touched_.size(); ++i) {
            const Vec3& here = now_[touched_[i].vertex];
            const auto ring = rings.row(touched_[i].vertex);
            Vec3 sum = Vec3::Zero();
            for (const VertexId u : ring) sum += now_[u] - here;
            moved_[i] = here + touched_[i].factor / static_cast<double>(ring.size()) * sum;
        }
        for (std::size_t i = 0; i < touched_.size(); ++i) now_[touched_[i].vertex] = moved_[i];
    }
}

void BrushStroke::inflate(double length) {
    moved_.resize(touched_.size());
    for (std::size_t i = 0; i < touched_.size(); ++i)
        moved_[i] = now_[touched_[i].vertex] +
                    touched_[i].factor * length * vertex_normal(touched_[i].vertex);
    for (std::size_t i = 0; i < touched_.size(); ++i) now_[touched_[i].vertex] = moved_[i];
}

void BrushStroke::paint() {
    for (const auto& [v, factor] : touched_)
        weights_[v] = std::clamp(weights_[v] + factor, 0.0, 1.0);
}

Vec3 BrushStroke::vertex_normal(VertexId v) const {
    Vec3 sum = Vec3::Zero();
    for (const TriangleId t : start_.topology->triangles_at().row(v))
        sum += area_normal(now_, start_.triangles()[t]);
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : Vec3::Zero();
}

TakenBack BrushStroke::keep_walls_apart(const Progress& progress) {
    return take_back_crossings(start_, now_, progress);
}

Surface BrushStroke::surface() const {
    if (settings_.kind != BrushKind::Weight) return start_.with_positions(now_);
    Surface painted = start_;
    painted.attributes[settings_.attribute] = std::make_shared<const std::vector<double>>(weights_);
    return painted;
}

}  // namespace vesselbench
