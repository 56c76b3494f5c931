#include "geometry/vessel/sac/sac_part.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "geometry/kernel/disjoint_sets.h"

namespace vesselbench {

namespace {

constexpr VertexId kUnnumbered = static_cast<VertexId>(-1);

/// Collects the part: numbers its vertices, clips its triangles and adds up its measures.
class SacClipper {
public:
    SacClipper(const Surface& surface, const Plane& plane)
        : surface_(surface), numbers_(surface.vertex_count(), kUnnumbered) {
        part_.neck = plane;
    }

    /// The vertices connected to the dome above the plane. \return false if one is foreign
    bool gather(VertexId dome, const std::vector<std::uint8_t>& foreign) {
        if (!above(dome)) return false;
        found_.push_back(dome);
        number(dome);
        for (std::size_t i = 0; i < found_.size(); ++i) {
            if (foreign[found_[i]] != 0) return false;
            for (const VertexId v : surface_.topology->rings().row(found_[i]))
                if (numbers_[v] == kUnnumbered && above(v)) {
                    found_.push_back(v);
                    number(v);
                }
        }
        return true;
    }

    /// \return false if the cut is not one closed curve
    bool clip() {
        for (const VertexId v : found_)
            for (const TriangleId t : surface_.topology->triangles_at().row(v)) visit(t, v);
        return single_curve();
    }

    SacPart finished() {
        const Vec3& n = part_.neck.normal;
        Vec3 doubled = Vec3::Zero();
        for (std::size_t i = 0; i + 1 < part_.outline.size(); i += 2) {
            const Vec3 a = part_.outline[i] - part_.neck.point;
            const Vec3 b = part_.outline[i + 1] - part_.neck.point;
            const double twice = n.dot(a.cross(b));
            part_.neck_area += 0.5 * twice;
            part_.neck_perimeter += (b - a).norm();
            doubled += twice * (a + b);
        }
        part_.neck_centroid = part_.neck.point + doubled / (6.0 * part_.neck_area);
        // Inward surfaces have negative figures, as everywhere.
        if (part_.neck_area < 0.0) part_.volume = -part_.volume;
        part_.neck_area = std::abs(part_.neck_area);
        return std::move(part_);
    }

private:
    bool above(VertexId v) const { return part_.neck.distance(surface_.points()[v]) > 0.0; }

    VertexId number(VertexId v) {
        if (numbers_[v] == kUnnumbered) {
            numbers_[v] = static_cast<VertexId>(part_.points.size());
            part_.points.push_back(surface_.points()[v]);
        }
        return numbers_[v];
    }

    /// The point where an edge crosses the plane.
    VertexId crossing(VertexId in, VertexId out) {
        const auto [known, added] =
            crossings_.try_emplace({in, out}, static_cast<VertexId>(part_.points.size()));
        if (added) {
            const Vec3 &a = surface_.points()[in], &b = surface_.points()[out];
            const double from = part_.neck.distance(a), to = part_.neck.distance(b);
            part_.points.push_back(a + from / (from - to) * (b - a));
            at_crossing_.push_back(known->second);
        }
        return known->second;
    }

    void add(VertexId a, VertexId b, VertexId c) {
        const Triangle triangle = {a, b, c};
        part_.triangles.push_back(triangle);
        const Vec3 &x = part_.points[a], &y = part_.points[b], &z = part_.points[c];
        part_.wall_area += 0.5 * (y - x).cross(z - x).norm();
        const Vec3& o = part_.neck.point;
        part_.volume += (x - o).dot((y - o).cross(z - o)) / 6.0;
    }

    /// A segment of the cut, in the direction of the outline seen from the sac.
    void cut(VertexId a, VertexId b) {
        part_.outline.push_back(part_.points[a]);
        part_.outline.push_back(part_.points[b]);
        segments_.emplace_back(a, b);
    }

    /// Each triangle is taken at its first corner above the plane.
    void visit(TriangleId t, VertexId v) {
        Triangle c = surface_.triangles()[t];
        const auto inside = [&](VertexId corner) { return above(corner); };
        const auto count = std::count_if(c.begin(), c.end(), inside);
        if (*std::find_if(c.begin(), c.end(), inside) != v) return;
        if (count == 3) {
            part_.whole.push_back(t);
            add(number(c[0]), number(c[1]), number(c[2]));
            return;
        }
        const bool alone = count == 1;
        while (inside(c[0]) != alone || inside(c[1]) == alone)
            std::rotate(c.begin(), c.begin() + 1, c.end());
        if (alone) {
            const VertexId a = crossing(c[0], c[1]), b = crossing(c[0], c[2]);
            add(number(c[0]), a, b);
            cut(a, b);
        } else {
            // c[0] is below; the others are above.
            const VertexId a = crossing(c[1], c[0]), b = crossing(c[2], c[0]);
            add(number(c[1]), number(c[2]), b);
            add(number(c[1]), b, a);
            cut(b, a);
        }
    }

    bool single_curve() {
        if (segments_.size() < 3 || segments_.size() != at_crossing_.size()) return false;
        DisjointSets sets(part_.points.size());
        for (const auto& [a, b] : segments_) sets.join(a, b);
        const auto root = sets.root(at_crossing_.front());
        return std::all_of(at_crossing_.begin(), at_crossing_.end(),
                           [&](VertexId v) { return sets.root(v) == root; });
    }

    const Surface& surface_;
    SacPart part_;
    std::vector<VertexId> numbers_;  ///< in the part, #V
    std::vector<VertexId> found_;    ///< of the surface, above the plane
    std::map<std::pair<VertexId, VertexId>, VertexId> crossings_;
    std::vector<VertexId> at_crossing_;
    std::vector<std::pair<VertexId, VertexId>> segments_;
};

}  // namespace

std::optional<SacPart> sac_above(const Surface& surface, const Plane& plane, VertexId dome,
                                 const std::vector<std::uint8_t>& foreign) {
    SacClipper clipper(surface, plane);
    if (!clipper.gather(dome, foreign) || !clipper.clip()) return std::nullopt;
    return clipper.finished();
}

}  // namespace vesselbench
