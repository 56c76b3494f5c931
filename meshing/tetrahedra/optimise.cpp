#include "meshing/tetrahedra/optimise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "meshing/tetrahedra/tet_store.h"

namespace vesselbench {

namespace {

using CellId = TetStore::CellId;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// An exchange or a move must gain this fraction of the energy, so that rounding cannot cause
// endless swaps.
constexpr double kGain = 1e-6;

double energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const double six_fold = u.cross(v).dot(w);
    if (six_fold <= 0.0) return kInfinite;
    const double edges = u.squaredNorm() + v.squaredNorm() + w.squaredNorm() +
                         (v - u).squaredNorm() + (w - u).squaredNorm() + (w - v).squaredNorm();
    return edges * edges * edges / (432.0 * six_fold * six_fold);
}

double energy(const Positions& p, const Tetrahedron& t) {
    return energy(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
}

double energy(const TetStore& store, const std::vector<CellId>& cells) {
    double sum = 0.0;
    for (const CellId cell : cells) sum += energy(store.points, store.cell(cell));
    return sum;
}

// Moves of single vertices -----------------------------------------------------------------------

// The cell with `v` as its last corner, still positive.
Tetrahedron seen_from(const Tetrahedron& cell, VertexId v) {
    for (int corner = 0; corner < 4; ++corner)
        if (cell[corner] == v) {
            const Triangle base = faces_of(cell)[corner];
            return {base[0], base[2], base[1], v};
        }
    return cell;
}

struct Descent {
    double energy = 0.0;
    Vec3 gradient = Vec3::Zero();
    Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

// Energy of a star, its gradient and the positive part of its second derivative by the position x.
Descent descent_at(const Positions& p, const std::vector<Tetrahedron>& star, const Vec3& x) {
    Descent sum;
    for (const auto& [a, b, c, v] : star) {
        const Vec3 &pa = p[a], &pb = p[b], &pc = p[c];
        const double e = energy(pa, pb, pc, x);
        const Vec3 area = (pb - pa).cross(pc - pa);
        const double height = area.dot(x - pa);
        const double base =
            (pb - pa).squaredNorm() + (pc - pb).squaredNorm() + (pa - pc).squaredNorm();
        const double edges =
            base + (x - pa).squaredNorm() + (x - pb).squaredNorm() + (x - pc).squaredNorm();
        const Vec3 by_height = area / height;
        const Vec3 slope = 6.0 * (3.0 * x - pa - pb - pc) / edges - 2.0 * by_height;
        sum.energy += e;
        sum.gradient += e * slope;
        sum.curvature += e * (slope * slope.transpose() + 2.0 * by_height * by_height.transpose() +
                              18.0 / edges * Eigen::Matrix3d::Identity());
    }
    return sum;
}

double star_energy(const Positions& p, const std::vector<Tetrahedron>& star, const Vec3& x,
                   double limit) {
    double sum = 0.0;
    for (const auto& [a, b, c, v] : star) {
        sum += energy(p[a], p[b], p[c], x);
        if (sum >= limit) return kInfinite;
    }
    return sum;
}

bool move_vertex(TetStore& store, VertexId v) {
    std::vector<Tetrahedron> star;
    for (const CellId cell : store.star(v)) star.push_back(seen_from(store.cell(cell), v));
    const Vec3 from = store.points[v];
    const Descent descent = descent_at(store.points, star, from);
    Vec3 step = -descent.curvature.ldlt().solve(descent.gradient);
    if (!step.allFinite()) return false;
    const double limit = descent.energy * (1.0 - kGain);
    for (int halving = 0; halving < 4; ++halving, step *= 0.5)
        if (star_energy(store.points, star, from + step, limit) < limit) {
            store.points[v] = from + step;
            return true;
        }
    return false;
}

std::size_t sweep_moves(TetStore& store) {
    std::size_t moved = 0;
    for (VertexId v = 0; v < store.points.size(); ++v)
        if (!store.on_boundary(v) && !store.star(v).empty() && move_vertex(store, v)) ++moved;
    return moved;
}

// Exchanges of edges and faces -------------------------------------------------------------------

// Triangulation of least cost of the ring around an edge, each triangle forming a cell with either
// end (Klincsek's dynamic programming).
class RingTriangulation {
public:
    RingTriangulation(const TetStore& store, VertexId a, VertexId b,
                      const std::vector<VertexId>& ring)
        : p_(store.points), a_(a), b_(b), ring_(ring) {
        const std::size_t n = ring.size();
        for (std::size_t i = 0; i + 1 < n; ++i) cost_[at(i, i + 1)] = 0.0;
        for (std::size_t span = 2; span < n; ++span)
            for (std::size_t i = 0; i + span < n; ++i) solve(i, i + span);
    }

    [[nodiscard]] double cost() const { return cost_[ring_.size() - 1]; }

    [[nodiscard]] std::vector<Tetrahedron> cells() const {
        std::vector<Tetrahedron> cells;
        collect(0, ring_.size() - 1, cells);
        return cells;
    }

private:
    [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const {
        return i * ring_.size() + j;
    }

    void solve(std::size_t i, std::size_t j) {
        double best = kInfinite;
        for (std::size_t k = i + 1; k < j; ++k) {
            const double rest = cost_[at(i, k)] + cost_[at(k, j)];
            if (rest >= best) continue;
            const Vec3 &x = p_[ring_[i]], &y = p_[ring_[k]], &z = p_[ring_[j]];
            const double total = rest + energy(x, y, z, p_[b_]) + energy(x, z, y, p_[a_]);
            if (total < best) {
                best = total;
                split_[at(i, j)] = static_cast<std::uint8_t>(k);
            }
        }
        cost_[at(i, j)] = best;
    }

    void collect(std::size_t i, std::size_t j, std::vector<Tetrahedron>& cells) const {
        if (j < i + 2) return;
        const std::size_t k = split_[at(i, j)];
        cells.push_back({ring_[i], ring_[k], ring_[j], b_});
        cells.push_back({ring_[i], ring_[j], ring_[k], a_});
        collect(i, k, cells);
        collect(k, j, cells);
    }

    const Positions& p_;
    VertexId a_, b_;
    const std::vector<VertexId>& ring_;
    std::array<double, TetStore::kLargestRing * TetStore::kLargestRing> cost_;
    std::array<std::uint8_t, TetStore::kLargestRing * TetStore::kLargestRing> split_;
};

bool remove_edge(TetStore& store, VertexId a, VertexId b, std::size_t largest_ring) {
    thread_local TetStore::Ring ring;
    if (!store.find_ring(a, b, largest_ring, ring)) return false;
    const double limit = energy(store, ring.cells) * (1.0 - kGain);
    // Each of the 2 (n - 2) new cells has an energy of at least 1.
    if (2.0 * static_cast<double>(ring.vertices.size() - 2) >= limit) return false;
    const RingTriangulation triangulation(store, a, b, ring.vertices);
    if (triangulation.cost() >= limit) return false;
    store.replace(ring.cells, triangulation.cells());
    return true;
}

// Two cells at a face become three around the edge between their tips.
bool remove_face(TetStore& store, CellId cell, int corner) {
    const auto other = store.behind(cell, corner);
    if (!other) return false;
    const VertexId tip = store.cell(cell)[corner];
    const Triangle face = faces_of(
        store.cell(cell))[corner];  // outward, counter-clockwise as seen from the other tip
    VertexId far = 0;
    for (const VertexId v : store.cell(*other))
        if (v != face[0] && v != face[1] && v != face[2]) far = v;
    const std::vector<Tetrahedron> fresh = {
        {tip, far, face[0], face[1]}, {tip, far, face[1], face[2]}, {tip, far, face[2], face[0]}};
    double cost = 0.0;
    for (const Tetrahedron& t : fresh) cost += energy(store.points, t);
    if (cost >= energy(store, {cell, *other}) * (1.0 - kGain)) return false;
    store.replace({cell, *other}, fresh);
    return true;
}

bool exchange_at(TetStore& store, CellId cell, std::size_t largest_ring) {
    const Tetrahedron corners = store.cell(cell);
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (remove_edge(store, corners[i], corners[j], largest_ring)) return true;
    for (int corner = 0; corner < 4; ++corner)
        if (remove_face(store, cell, corner)) return true;
    return false;
}

std::size_t sweep_exchanges(TetStore& store, const OptimiseParameters& parameters) {
    std::size_t exchanged = 0;
    const std::size_t count = store.cell_count();
    for (CellId cell = 0; cell < count; ++cell)
        if (store.alive(cell) && energy(store.points, store.cell(cell)) > parameters.exchange &&
            exchange_at(store, cell, parameters.largest_ring))
            ++exchanged;
    return exchanged;
}

}  // namespace

VolumeMesh optimised(const VolumeMesh& mesh, const OptimiseParameters& parameters,
                     const Progress& progress, OptimiseReport* report) {
    TetStore store(mesh);
    OptimiseReport done;
    for (int round = 0; round < parameters.rounds; ++round) {
        progress.report(static_cast<double>(round) / parameters.rounds, "improving the cells");
        for (int repeat = 0; repeat < 3; ++repeat) {
            const std::size_t exchanged = sweep_exchanges(store, parameters);
            done.exchanges += exchanged;
            if (exchanged * 200 < store.cell_count()) break;
        }
        for (int sweep = 0; sweep < parameters.moves; ++sweep) {
            progress.check_cancelled();
            done.moves += sweep_moves(store);
        }
    }
    done.exchanges += sweep_exchanges(store, parameters);
    if (report != nullptr) *report = done;
    VolumeMesh better = mesh;
    better.tetrahedra = store.cells();
    better.points = std::move(store.points);
    return better;
}

}  // namespace vesselbench
