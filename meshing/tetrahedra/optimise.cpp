#include "meshing/tetrahedra/optimise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

#include "meshing/tetrahedra/tet_store.h"

namespace vesselbench {

namespace {

using CellId = TetStore::CellId;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// An exchange or a move must gain this fraction of the energy, so that rounding cannot cause
// endless swaps.
constexpr double kGain = 1e-6;
// A vertex that gains less than this fraction has settled: its neighbours need not follow.
constexpr double kSettled = 2e-3;

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

enum class Moved { No, Little, Far };

Moved move_vertex(TetStore& store, VertexId v) {
    thread_local std::vector<Tetrahedron> star;
    star.clear();
    for (const CellId cell : store.star(v)) star.push_back(seen_from(store.cell(cell), v));
    const Vec3 from = store.points[v];
    const Descent descent = descent_at(store.points, star, from);
    Vec3 step = -descent.curvature.ldlt().solve(descent.gradient);
    if (!step.allFinite()) return Moved::No;
    const double limit = descent.energy * (1.0 - kGain);
    for (int halving = 0; halving < 4; ++halving, step *= 0.5) {
        const double reached = star_energy(store.points, star, from + step, limit);
        if (reached >= limit) continue;
        store.points[v] = from + step;
        return reached < descent.energy * (1.0 - kSettled) ? Moved::Far : Moved::Little;
    }
    return Moved::No;
}

// Exchanges of edges and faces -------------------------------------------------------------------

// Triangulation of least cost of the ring around an edge, each triangle forming a cell with either
// end (Klincsek's dynamic programming).
class RingTriangulation {
public:
    /// \param limit only triangulations of less cost count
    RingTriangulation(const TetStore& store, VertexId a, VertexId b,
                      const std::vector<VertexId>& ring, double limit)
        : p_(store.points), a_(a), b_(b), limit_(limit), ring_(ring) {
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
        double best = limit_;
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
        cost_[at(i, j)] = best < limit_ ? best : kInfinite;
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
    double limit_;
    const std::vector<VertexId>& ring_;
    std::array<double, TetStore::kLargestRing * TetStore::kLargestRing> cost_;
    std::array<std::uint8_t, TetStore::kLargestRing * TetStore::kLargestRing> split_;
};

// Vertices in ranges of their numbers, which are regions in space. Shifted by half a range, the
// second partition has most of the borders of the first within its ranges.
struct Partition {
    static constexpr std::uint32_t kRange = 8192;

    std::uint32_t shift = 0;

    [[nodiscard]] std::uint32_t range_of(VertexId v) const { return (v + shift) / kRange; }

    [[nodiscard]] bool is_within(const Tetrahedron& t, std::uint32_t range) const {
        return range_of(t[0]) == range && range_of(t[1]) == range && range_of(t[2]) == range &&
               range_of(t[3]) == range;
    }
};

constexpr std::array<Partition, 2> kPartitions = {{{0}, {Partition::kRange / 2}}};

// Improves cells range by range on all threads, each changing only what lies within its range, and
// what crosses their borders on one thread at the end: the result is the same for any number of
// threads. What has failed is tried again only if something changed there since.
class Improver {
public:
    Improver(const VolumeMesh& mesh, const OptimiseParameters& parameters)
        : store_(mesh),
          parameters_(parameters),
          ranges_(mesh.points.size() / Partition::kRange + 2),
          slots_(ranges_ + 1),
          changed_(mesh.points.size(), 1),
          settled_(mesh.points.size(), 0) {}

    /// \return the number of exchanges
    std::size_t exchange();

    /// \return the number of vertices moved
    std::size_t move();

    [[nodiscard]] TetStore& store() { return store_; }

private:
    enum class Outcome { Done, Nothing, Crosses };

    /// Where a thread works: in one range of a partition, or everywhere.
    struct Region {
        const Partition* partition;  ///< null: everywhere
        std::uint32_t range;
        TetStore::Slots& slots;

        [[nodiscard]] bool holds(VertexId v) const {
            return partition == nullptr || partition->range_of(v) == range;
        }
    };

    [[nodiscard]] std::vector<CellId> poor_cells();
    std::size_t exchange_within(const Partition& partition, std::vector<CellId>& cells);
    std::size_t exchange_everywhere(const std::vector<CellId>& cells);
    void follow_growth();
    Outcome exchange_at(CellId cell, const Region& region);
    Outcome remove_edge(VertexId a, VertexId b, const Region& region);
    Outcome remove_face(CellId cell, int corner, const Region& region);
    Outcome replace(const std::vector<CellId>& old, const std::vector<Tetrahedron>& fresh,
                    const Region& region);

    [[nodiscard]] double energy_of(const std::vector<CellId>& cells) const {
        double sum = 0.0;
        for (const CellId cell : cells) sum += energies_[cell];
        return sum;
    }

    [[nodiscard]] std::uint8_t place_of(VertexId v) const;
    bool move_one(VertexId v);

    TetStore store_;
    OptimiseParameters parameters_;
    std::size_t ranges_;
    std::vector<TetStore::Slots> slots_;  // by range; the last for what crosses
    std::vector<double> energies_;        // by cell
    std::vector<std::uint32_t> tried_;    // by cell: when exchanges there failed
    std::vector<std::uint32_t> changed_;  // by vertex: when it, or a cell at it, changed
    std::vector<std::uint32_t> settled_;  // by vertex: when it was moved last
    std::uint32_t now_ = 1;               // counts sweeps
    bool moved_ = true;                   // since energies_ were computed
};

void Improver::follow_growth() {
    energies_.resize(store_.cell_count(), 0.0);
    tried_.resize(store_.cell_count(), 0);
}

std::vector<CellId> Improver::poor_cells() {
    constexpr std::size_t kChunk = 8192;
    follow_growth();
    const std::size_t count = store_.cell_count();
    std::vector<std::vector<CellId>> parts(count / kChunk + 1);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
        const auto end = static_cast<CellId>(std::min(count, (part + 1) * kChunk));
        for (auto cell = static_cast<CellId>(part * kChunk); cell < end; ++cell) {
            if (!store_.alive(cell)) continue;
            const Tetrahedron& t = store_.cell(cell);
            if (moved_) energies_[cell] = energy(store_.points, t);
            if (energies_[cell] <= parameters_.exchange) continue;
            if (std::ranges::any_of(t, [&](VertexId v) { return changed_[v] >= tried_[cell]; }))
                parts[part].push_back(cell);
        }
    });
    moved_ = false;
    std::vector<CellId> cells;
    for (const auto& part : parts) cells.insert(cells.end(), part.begin(), part.end());
    return cells;
}

Improver::Outcome Improver::replace(const std::vector<CellId>& old,
                                    const std::vector<Tetrahedron>& fresh, const Region& region) {
    thread_local std::vector<CellId> added;
    if (region.partition == nullptr) {
        store_.provide(region.slots, fresh.size());
        follow_growth();
    }
    if (!store_.replace(old, fresh, region.slots, added)) return Outcome::Crosses;
    for (const CellId cell : added) {
        energies_[cell] = energy(store_.points, store_.cell(cell));
        tried_[cell] = 0;
        for (const VertexId v : store_.cell(cell)) changed_[v] = now_;
    }
    return Outcome::Done;
}

Improver::Outcome Improver::remove_edge(VertexId a, VertexId b, const Region& region) {
    thread_local TetStore::Ring ring;
    if (!store_.find_ring(a, b, parameters_.largest_ring, ring)) return Outcome::Nothing;
    if (!std::ranges::all_of(ring.vertices, [&](VertexId v) { return region.holds(v); }))
        return Outcome::Crosses;
    const double limit = energy_of(ring.cells) * (1.0 - kGain);
    // Each of the 2 (n - 2) new cells has an energy of at least 1.
    if (2.0 * static_cast<double>(ring.vertices.size() - 2) >= limit) return Outcome::Nothing;
    const RingTriangulation triangulation(store_, a, b, ring.vertices, limit);
    if (triangulation.cost() >= limit) return Outcome::Nothing;
    return replace(ring.cells, triangulation.cells(), region);
}

// Two cells at a face become three around the edge between their tips.
Improver::Outcome Improver::remove_face(CellId cell, int corner, const Region& region) {
    const auto other = store_.behind(cell, corner);
    if (!other) return Outcome::Nothing;
    const VertexId tip = store_.cell(cell)[corner];
    const Triangle face = faces_of(
        store_.cell(cell))[corner];  // outward, counter-clockwise as seen from the other tip
    VertexId far = 0;
    for (const VertexId v : store_.cell(*other))
        if (v != face[0] && v != face[1] && v != face[2]) far = v;
    if (!region.holds(far)) return Outcome::Crosses;
    const std::array<Tetrahedron, 3> fresh = {
        {{tip, far, face[0], face[1]}, {tip, far, face[1], face[2]}, {tip, far, face[2], face[0]}}};
    const double limit = (energies_[cell] + energies_[*other]) * (1.0 - kGain);
    double cost = 0.0;
    for (const Tetrahedron& t : fresh) {
        cost += energy(store_.points, t);
        if (cost >= limit) return Outcome::Nothing;
    }
    return replace({cell, *other}, {fresh.begin(), fresh.end()}, region);
}

Improver::Outcome Improver::exchange_at(CellId cell, const Region& region) {
    const Tetrahedron corners = store_.cell(cell);
    bool crosses = false;
    const auto done = [&](Outcome outcome) {
        crosses |= outcome == Outcome::Crosses;
        return outcome == Outcome::Done;
    };
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (done(remove_edge(corners[i], corners[j], region))) return Outcome::Done;
    for (int corner = 0; corner < 4; ++corner)
        if (done(remove_face(cell, corner, region))) return Outcome::Done;
    if (crosses) return Outcome::Crosses;
    tried_[cell] = now_;
    return Outcome::Nothing;
}

// Leaves in `cells` those that need more than one range.
std::size_t Improver::exchange_within(const Partition& partition, std::vector<CellId>& cells) {
    constexpr std::size_t kSlots = 4096;
    std::vector<std::vector<CellId>> lists(ranges_), left(ranges_);
    std::vector<CellId> crossing;
    for (const CellId cell : cells) {
        const std::uint32_t range = partition.range_of(store_.cell(cell)[0]);
        (partition.is_within(store_.cell(cell), range) ? lists[range] : crossing).push_back(cell);
    }
    for (std::size_t range = 0; range < ranges_; ++range)
        if (!lists[range].empty()) store_.provide(slots_[range], kSlots);
    follow_growth();
    std::vector<std::size_t> exchanged(ranges_, 0);
    tbb::parallel_for(
        std::size_t{0}, ranges_,
        [&](std::size_t range) {
            const Region region{&partition, static_cast<std::uint32_t>(range), slots_[range]};
            for (const CellId cell : lists[range]) {
                if (!store_.alive(cell) || energies_[cell] <= parameters_.exchange) continue;
                const Outcome outcome = exchange_at(cell, region);
                exchanged[range] += outcome == Outcome::Done ? 1 : 0;
                if (outcome == Outcome::Crosses) left[range].push_back(cell);
            }
        },
        tbb::simple_partitioner());
    for (const auto& list : left) crossing.insert(crossing.end(), list.begin(), list.end());
    cells = std::move(crossing);
    std::size_t sum = 0;
    for (const std::size_t count : exchanged) sum += count;
    return sum;
}

std::size_t Improver::exchange_everywhere(const std::vector<CellId>& cells) {
    const Region region{nullptr, 0, slots_.back()};
    std::size_t exchanged = 0;
    for (const CellId cell : cells)
        if (store_.alive(cell) && energies_[cell] > parameters_.exchange &&
            exchange_at(cell, region) == Outcome::Done)
            ++exchanged;
    return exchanged;
}

std::size_t Improver::exchange() {
    ++now_;
    std::vector<CellId> cells = poor_cells();
    std::size_t exchanged = 0;
    for (const Partition& partition : kPartitions) exchanged += exchange_within(partition, cells);
    return exchanged + exchange_everywhere(cells);
}

constexpr std::uint8_t kStays = 0xff;

// The partition that has the whole star of v in one range, their number if none has; kStays if
// nothing there has changed since v was moved last.
std::uint8_t Improver::place_of(VertexId v) const {
    if (store_.on_boundary(v) || store_.star(v).empty()) return kStays;
    bool changed = false;
    std::array<bool, kPartitions.size()> within;
    within.fill(true);
    for (const CellId cell : store_.star(v))
        for (const VertexId u : store_.cell(cell)) {
            changed |= changed_[u] >= settled_[v];
            for (std::size_t i = 0; i < kPartitions.size(); ++i)
                within[i] &= kPartitions[i].range_of(u) == kPartitions[i].range_of(v);
        }
    if (!changed) return kStays;
    return static_cast<std::uint8_t>(std::find(within.begin(), within.end(), true) -
                                     within.begin());
}

bool Improver::move_one(VertexId v) {
    settled_[v] = now_;
    const Moved moved = move_vertex(store_, v);
    if (moved == Moved::Far) changed_[v] = now_;
    return moved != Moved::No;
}

std::size_t Improver::move() {
    ++now_;
    moved_ = true;
    const std::size_t count = store_.points.size();
    std::vector<std::uint8_t> place(count);
    tbb::parallel_for(std::size_t{0}, count,
                      [&](std::size_t v) { place[v] = place_of(static_cast<VertexId>(v)); });
    std::vector<std::size_t> moved(ranges_ + 1, 0);
    for (std::size_t i = 0; i < kPartitions.size(); ++i)
        tbb::parallel_for(
            std::size_t{0}, ranges_,
            [&](std::size_t range) {
                const std::size_t shift = kPartitions[i].shift, kRange = Partition::kRange;
                const std::size_t begin = range * kRange - std::min(range * kRange, shift),
                                  end = std::min(count, (range + 1) * kRange - shift);
                for (std::size_t v = begin; v < end; ++v)
                    if (place[v] == i) moved[range] += move_one(static_cast<VertexId>(v)) ? 1 : 0;
            },
            tbb::simple_partitioner());
    for (VertexId v = 0; v < count; ++v)
        if (place[v] == kPartitions.size()) moved.back() += move_one(v) ? 1 : 0;
    std::size_t sum = 0;
    for (const std::size_t part : moved) sum += part;
    return sum;
}

}  // namespace

VolumeMesh optimised(const VolumeMesh& mesh, const OptimiseParameters& parameters,
                     const Progress& progress, OptimiseReport* report) {
    Improver improver(mesh, parameters);
    OptimiseReport done;
    const int sweeps = parameters.rounds * (parameters.moves + 1);
    int sweep = 0;
    const auto say = [&] {
        progress.report(std::min(1.0, static_cast<double>(sweep++) / std::max(1, sweeps)),
                        "improving the cells");
    };
    for (int round = 0; round < parameters.rounds; ++round) {
        say();
        for (int repeat = 0; repeat < 3; ++repeat) {
            const std::size_t exchanged = improver.exchange();
            done.exchanges += exchanged;
            progress.check_cancelled();
            if (exchanged * 200 < mesh.tetrahedra.size()) break;
        }
        for (int move = 0; move < parameters.moves; ++move) {
            say();
            done.moves += improver.move();
        }
    }
    done.exchanges += improver.exchange();
    if (report != nullptr) *report = done;
    VolumeMesh better = mesh;
    better.points = std::move(improver.store().points);
    better.tetrahedra = improver.store().cells();
    return better;
}

}  // namespace vesselbench
