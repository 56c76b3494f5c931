#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/image/flying_edges.h"
#include "geometry/kernel/errors.h"
#include "tests/forest/dice.h"
#include "tests/forest/grow.h"
#include "tests/forest/model.h"

namespace vesselbench::forest {

namespace {

/// Newton steps that move a vertex onto the wall.
constexpr int kNewtonSteps = 3;
/// A vertex this near to a cut is moved onto it [edges].
constexpr double kSnap = 0.08;

/// Triangles that are being cut; unused vertices are dropped at the end.
struct Mesh {
    Positions points;
    std::vector<Triangle> triangles;
};

Vec3 on_wall(const TreeField& field, const TreeField::Near& near, Vec3 p, double edge) {
    for (int step = 0; step < kNewtonSteps; ++step) {
        const Vec3 gradient = field.gradient(near, p);
        const double steepness = gradient.squaredNorm();
        if (steepness < 0.04) break;
        const Vec3 move = field.value(near, p) / steepness * gradient;
        p -= std::min(1.0, 0.5 * edge / std::max(move.norm(), 1e-12)) * move;
    }
    return p;
}

void move_to_wall(Positions& points, const TreeField& field, double edge) {
    constexpr double kCell = 8.0;  // edges
    std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
    for (std::size_t v = 0; v < points.size(); ++v) {
        const Eigen::Array3i at = (points[v].array() / (kCell * edge)).floor().cast<int>();
        cells[{at[0], at[1], at[2]}].push_back(v);
    }
    for (const auto& [at, inside] : cells) {
        const Vec3 centre = kCell * edge * (Vec3(at[0], at[1], at[2]) + Vec3::Constant(0.5));
        const auto near = field.near(centre, kCell * edge);
        for (const std::size_t v : inside) points[v] = on_wall(field, near, points[v], edge);
    }
}

Mesh extracted(const TreeField& field, double edge) {
    Eigen::AlignedBox3d box = field.bounds();
    const Vec3 origin = box.min() - Vec3::Constant(2.37 * edge);
    const Eigen::Array3i size =
        ((box.sizes() + Vec3::Constant(4.74 * edge)) / edge).array().ceil().cast<int>() + 1;
    const auto values = sampled(field, origin, edge * Eigen::Matrix3d::Identity(), size);
    const GridSurface found =
        flying_edges(std::span<const float>(values),
                     {.size = {size[0], size[1], size[2]}, .origin = Vec3::Zero(), .spacing = 1.0});
    Mesh mesh;
    for (const auto& [x, y, z] : found.points) mesh.points.push_back(origin + edge * Vec3(x, y, z));
    move_to_wall(mesh.points, field, edge);
    for (const auto& [a, b, c] : found.triangles)
        if (a != b && b != c && c != a) mesh.triangles.push_back({a, c, b});
    return mesh;
}

/// Cuts a vessel's end by its plane; the rim is exactly flat.
class FlatCut {
public:
    FlatCut(Mesh& mesh, const Tree& tree, const Branch& branch, double edge)
        : mesh_(mesh), end_(*branch.end) {
        heights_.reserve(mesh.points.size());
        for (Vec3& p : mesh_.points) {
            double height = (p - end_.place).dot(end_.rim_normal);
            const bool here = is_at_end(tree, branch, p);
            if (here && std::abs(height) < kSnap * edge) {
                p -= height * end_.rim_normal;
                height = 0.0;
            }
            heights_.push_back(here ? height : -1.0);
        }
    }

    /// \param close by a fan of triangles
    void run(bool close) {
        std::vector<Triangle> before;
        before.swap(mesh_.triangles);
        for (const Triangle& t : before) cut(t);
        if (close) add_cap();
    }

private:
    [[nodiscard]] bool beyond(VertexId v) const { return heights_[v] > 0.0; }

    VertexId crossing(VertexId a, VertexId b) {
        const auto key = std::minmax(a, b);
        const auto found = crossings_.find(key);
        if (found != crossings_.end()) return found->second;
        const auto [low, high] = key;
        const double u = heights_[low] / (heights_[low] - heights_[high]);
        const auto made = static_cast<VertexId>(mesh_.points.size());
        mesh_.points.push_back(mesh_.points[low] + u * (mesh_.points[high] - mesh_.points[low]));
        heights_.push_back(0.0);
        crossings_[key] = made;
        return made;
    }

    void cut(const Triangle& t) {
        std::vector<VertexId> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId a = t[k], b = t[(k + 1) % 3];
            if (!beyond(a)) polygon.push_back(a);
            const bool crosses = heights_[a] * heights_[b] < 0.0;
            if (crosses) polygon.push_back(crossing(a, b));
        }
        // what only touches the plane from beyond is gone
        const bool kept = std::ranges::any_of(t, [&](VertexId v) { return heights_[v] < 0.0; });
        if (polygon.size() < 3 || !kept) return;
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
            mesh_.triangles.push_back({polygon[0], polygon[k], polygon[k + 1]});
    }

    void add_cap() {
        std::map<std::pair<VertexId, VertexId>, int> edges;
        for (const Triangle& t : mesh_.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const VertexId a = t[k], b = t[(k + 1) % 3];
                if (heights_[a] == 0.0 && heights_[b] == 0.0) {
                    ++edges[{a, b}];
                    --edges[{b, a}];
                }
            }
        const auto centre = static_cast<VertexId>(mesh_.points.size());
        mesh_.points.push_back(end_.place);
        for (const auto& [edge, count] : edges)
            if (count > 0) mesh_.triangles.push_back({edge.second, edge.first, centre});
    }

    Mesh& mesh_;
    const End& end_;
    std::vector<double> heights_;  ///< above the plane, per vertex; negative away from the end [mm]
    std::map<std::pair<VertexId, VertexId>, VertexId> crossings_;
};

/// Vertices where several parts of a rim meet, and the triangles there.
bool drop_touching_rims(Mesh& mesh) {
    std::map<std::pair<VertexId, VertexId>, int> sides;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
    std::map<VertexId, int> rims;
    for (const auto& [edge, count] : sides)
        if (count == 1) ++rims[edge.first], ++rims[edge.second];
    return std::erase_if(mesh.triangles, [&](const Triangle& t) {
               return std::ranges::any_of(t, [&](VertexId v) {
                   const auto found = rims.find(v);
                   return found != rims.end() && found->second > 2;
               });
           }) > 0;
}

/// Leaves out whole triangles, so that the rim is ragged.
void cut_ragged(Mesh& mesh, const Tree& tree, const Branch& branch) {
    std::vector<bool> gone;
    for (const Vec3& p : mesh.points) gone.push_back(is_cut_away(tree, branch, p));
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return std::ranges::any_of(t, [&](VertexId v) { return gone[v]; });
    });
    while (drop_touching_rims(mesh)) {
    }
}

Surface compact(const Mesh& mesh) {
    constexpr auto kUnused = static_cast<VertexId>(-1);
    std::vector<VertexId> number(mesh.points.size(), kUnused);
    Positions points;
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& t : triangles)
        for (VertexId& v : t) {
            if (number[v] == kUnused) {
                number[v] = static_cast<VertexId>(points.size());
                points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace

Surface tree_surface(const Tree& tree, const Plan& plan) {
    const double edge = edge_for(plan, tree);
    Mesh mesh = extracted(TreeField(tree), edge);
    for (const Branch& branch : tree.branches) {
        if (!branch.end || branch.end->kind == EndKind::Rounded) continue;
        if (branch.end->kind == EndKind::Ragged)
            cut_ragged(mesh, tree, branch);
        else
            FlatCut(mesh, tree, branch, edge).run(plan.kind != CaseKind::OpenSurface);
    }
    return compact(mesh);
}

Surface voxel_surface(const Tree& tree, const Plan& plan) {
    const Image mask = tree_image(tree, plan);
    std::vector<float> values(*mask.voxels);
    for (float& value : values) value = 0.5F - value;
    const GridSurface found =
        flying_edges(std::span<const float>(values),
                     {.size = mask.size, .origin = Vec3::Zero(), .spacing = 1.0});
    Mesh mesh;
    for (const auto& [x, y, z] : found.points)
        mesh.points.push_back(mask.to_patient(Vec3(x, y, z)));
    for (const auto& [a, b, c] : found.triangles) mesh.triangles.push_back({a, c, b});
    return compact(mesh);
}

}  // namespace vesselbench::forest
