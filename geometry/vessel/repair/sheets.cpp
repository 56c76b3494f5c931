#include "geometry/vessel/repair/sheets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/repair/soup.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// If reversing triangles leaves contradictions at more than this fraction of the triangles [-],
/// the surface is one-sided; fewer are cut out.
constexpr double kMostContradictions = 0.005;

/// Half-edge 3 t + k paired with that of the neighbour on the same sheet, or kNone.
using Mates = std::vector<std::uint32_t>;

struct Around {
    double angle = 0.0;
    std::uint32_t half_edge = 0;
    bool forward = false;  ///< runs from the edge's low to its high vertex
};

VertexId apex(const TriangleSoup& mesh, std::uint32_t half_edge) {
    return mesh.triangles[half_edge / 3][(half_edge % 3 + 2) % 3];
}

/// The half-edges of an edge by the angle of their triangles around it.
std::vector<Around> sorted_around(const TriangleSoup& mesh, const std::array<VertexId, 2>& edge,
                                  std::span<const std::uint32_t> half_edges) {
    const Vec3 origin = mesh.points[edge[0]];
    const Vec3 axis = (mesh.points[edge[1]] - origin).normalized();
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<Around> around;
    for (const std::uint32_t h : half_edges) {
        const Vec3 to = mesh.points[apex(mesh, h)] - origin;
        around.push_back(
            {std::atan2(to.dot(v), to.dot(u)), h, mesh.triangles[h / 3][h % 3] == edge[0]});
    }
    std::sort(around.begin(), around.end(), [](const Around& a, const Around& b) {
        return a.angle < b.angle || (a.angle == b.angle && a.half_edge < b.half_edge);
    });
    return around;
}

/// Joins neighbours around the edge that enclose a wedge of the solid, narrowest wedges first. With
/// outward normals the solid is before a forward triangle, in the direction of increasing angles.
void pair_around(std::vector<Around> around, Mates& mates) {
    while (around.size() > 1) {
        std::size_t best = around.size();
        double narrowest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < around.size(); ++i) {
            const Around &a = around[i], &b = around[(i + 1) % around.size()];
            if (a.forward || !b.forward) continue;
            double wedge = b.angle - a.angle;
            if (wedge < 0.0) wedge += 2.0 * std::numbers::pi;
            if (wedge >= narrowest) continue;
            narrowest = wedge;
            best = i;
        }
        if (best == around.size()) return;
        const std::size_t other = (best + 1) % around.size();
        mates[around[best].half_edge] = around[other].half_edge;
        mates[around[other].half_edge] = around[best].half_edge;
        around.erase(around.begin() + static_cast<std::ptrdiff_t>(std::max(best, other)));
        around.erase(around.begin() + static_cast<std::ptrdiff_t>(std::min(best, other)));
    }
}

struct Sheets {
    Mates mates;
    std::vector<std::uint8_t> at_crossing;  ///< #V, 1 at the ends of non-manifold edges
    std::size_t crossings = 0;
};

Sheets sheets_of(const TriangleSoup& mesh, RepairReport& report) {
    const EdgeTable table = edge_table(Topology(mesh.triangles, mesh.points.size()));
    Sheets sheets;
    sheets.mates.assign(3 * mesh.triangles.size(), kNone);
    sheets.at_crossing.assign(mesh.points.size(), 0);
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const auto row = table.half_edges.row(e);
        if (row.size() == 2) {
            sheets.mates[row[0]] = row[1];
            sheets.mates[row[1]] = row[0];
        } else if (row.size() > 2) {
            ++sheets.crossings;
            const auto& [a, b] = table.edges[e];
            sheets.at_crossing[a] = sheets.at_crossing[b] = 1;
            pair_around(sorted_around(mesh, table.edges[e], row), sheets.mates);
            report.places.push_back({RepairKind::NonManifold,
                                     0.5 * (mesh.points[a] + mesh.points[b]),
                                     0.5 * (mesh.points[a] - mesh.points[b]).norm()});
        }
    }
    report.non_manifold_edges += sheets.crossings;
    return sheets;
}

/// True if both triangles traverse the shared edge in the same direction.
bool disagree(const TriangleSoup& mesh, std::uint32_t h, std::uint32_t mate) {
    return mesh.triangles[h / 3][h % 3] == mesh.triangles[mate / 3][mate % 3];
}

/// The triangles to reverse so that neighbours agree; as few as possible per connected sheet.
std::vector<std::uint8_t> turns(const TriangleSoup& mesh, const Mates& mates) {
    constexpr std::uint8_t kUnseen = 2;
    std::vector<std::uint8_t> turn(mesh.triangles.size(), kUnseen);
    std::vector<TriangleId> sheet;
    for (TriangleId seed = 0; seed < turn.size(); ++seed) {
        if (turn[seed] != kUnseen) continue;
        sheet.assign(1, seed);
        turn[seed] = 0;
        std::size_t turned = 0;
        for (std::size_t i = 0; i < sheet.size(); ++i)
            for (std::uint32_t h = 3 * sheet[i]; h < 3 * sheet[i] + 3; ++h) {
                if (mates[h] == kNone || turn[mates[h] / 3] != kUnseen) continue;
                const auto flip = static_cast<std::uint8_t>(disagree(mesh, h, mates[h]) ? 1 : 0);
                turn[mates[h] / 3] = turn[sheet[i]] ^ flip;
                turned += turn[mates[h] / 3];
                sheet.push_back(mates[h] / 3);
            }
        if (2 * turned > sheet.size())
            for (const TriangleId t : sheet) turn[t] ^= 1;
    }
    return turn;
}

/// Triangles at edges that still disagree after all reversals: the sheet is one-sided there.
std::vector<std::uint8_t> contradictions(const TriangleSoup& mesh, const Mates& mates,
                                         const std::vector<std::uint8_t>& turn) {
    std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
    for (std::uint32_t h = 0; h < mates.size(); ++h) {
        if (mates[h] == kNone) continue;
        const bool differ = turn[h / 3] != turn[mates[h] / 3];
        if (disagree(mesh, h, mates[h]) != differ) marked[h / 3] = 1;
    }
    return marked;
}

/// Cuts out contradictory triangles. \return true if there were any
bool cut_contradictions(TriangleSoup& mesh, const std::vector<std::uint8_t>& marked,
                        RepairReport& report) {
    const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
    if (count == 0) return false;
    Vec3 place = Vec3::Zero();
    for (TriangleId t = 0; t < marked.size(); ++t)
        if (marked[t]) {
            place = centroid(mesh, mesh.triangles[t]);
            report.places.push_back({RepairKind::Orientation, place, 0.0});
            for (const VertexId v : mesh.triangles[t]) mesh.marks[v] = 1;
        }
    if (static_cast<double>(count) > kMostContradictions * static_cast<double>(marked.size()))
        throw DiagnosedFailure({.code = "surface-one-sided",
                                .place = place,
                                .figures = {{"triangles", static_cast<double>(count)}}});
    mesh.remove_triangles(marked);
    return true;
}

/// Corners of triangles joined along the sheets: each set at a vertex is one fan.
class Fans {
public:
    Fans(const TriangleSoup& mesh, const Mates& mates)
        : mesh_(mesh), sets_(3 * mesh.triangles.size()) {
        for (std::uint32_t h = 0; h < mates.size(); ++h) {
            if (mates[h] == kNone || mates[h] < h) continue;
            const Triangle& t = mesh.triangles[h / 3];
            for (const VertexId v : {t[h % 3], t[(h % 3 + 1) % 3]})
                sets_.join(corner(h / 3, v), corner(mates[h] / 3, v));
        }
    }

    std::uint32_t root(std::uint32_t c) { return sets_.root(c); }

private:
    [[nodiscard]] std::uint32_t corner(TriangleId triangle, VertexId v) const {
        return 3 * triangle + corner_of(mesh_.triangles[triangle], v);
    }

    const TriangleSoup& mesh_;
    DisjointSets sets_;
};

/// Gives every fan except the first its own copy of the vertex.
void part_fans(TriangleSoup& mesh, const Sheets& sheets, bool part_rims, RepairReport& report) {
    Fans fans(mesh, sheets.mates);
    // A fan is open if one of its corners is at an unpaired half-edge.
    std::vector<std::uint8_t> open(3 * mesh.triangles.size(), 0);
    for (std::uint32_t h = 0; h < sheets.mates.size(); ++h)
        if (sheets.mates[h] == kNone) {
            open[fans.root(h)] = 1;
            open[fans.root(h / 3 * 3 + (h % 3 + 1) % 3)] = 1;
        }
    std::vector<std::uint32_t> first(mesh.points.size(), kNone);
    std::map<std::uint32_t, VertexId> copies;  // of the few fans that are split
    std::vector<VertexId> parted;
    const std::vector<Triangle> before = mesh.triangles;
    for (std::uint32_t c = 0; c < open.size(); ++c) {
        const VertexId v = before[c / 3][c % 3];
        const std::uint32_t fan = fans.root(c);
        if (first[v] == kNone) first[v] = fan;
        if (first[v] == fan) continue;
        if (open[fan] && open[first[v]] && !part_rims && !sheets.at_crossing[v]) continue;
        const auto [copy, fresh] = copies.try_emplace(fan, 0);
        if (fresh) {
            copy->second = mesh.add_copy(v);
            parted.push_back(v);
        }
        mesh.triangles[c / 3][c % 3] = copy->second;
    }
    std::sort(parted.begin(), parted.end());
    parted.erase(std::unique(parted.begin(), parted.end()), parted.end());
    report.non_manifold_vertices += parted.size();
    for (const VertexId v : parted)
        report.places.push_back({RepairKind::NonManifold, mesh.points[v], 0.0});
}

/// Sheets joined elsewhere at both ends of an edge cannot be split there: their triangles at that
/// edge are cut out. \return true if there were any
bool cut_remaining_crossings(TriangleSoup& mesh) {
    const EdgeTable table = edge_table(Topology(mesh.triangles, mesh.points.size()));
    std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
    bool any = false;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const auto row = table.half_edges.row(e);
        if (row.size() <= 2) continue;
        any = true;
        for (const std::uint32_t h : row) {
            marked[h / 3] = 1;
            for (const VertexId v : mesh.triangles[h / 3]) mesh.marks[v] = 1;
        }
    }
    if (any) mesh.remove_triangles(marked);
    return any;
}

}  // namespace

void make_manifold(TriangleSoup& mesh, bool part_rims, RepairReport& report) {
    constexpr int kMostCuts = 10;
    for (int cuts = 0; cuts < kMostCuts; ++cuts) {
        RepairReport found;  // counted once, from the last pass
        const Sheets sheets = sheets_of(mesh, found);
        const std::vector<std::uint8_t> turn = turns(mesh, sheets.mates);
        if (cut_contradictions(mesh, contradictions(mesh, sheets.mates, turn), report)) continue;
        part_fans(mesh, sheets, part_rims, found);
        for (TriangleId t = 0; t < turn.size(); ++t) {
            if (!turn[t]) continue;
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
            ++found.turned_triangles;
        }
        report.non_manifold_edges += found.non_manifold_edges;
        report.non_manifold_vertices += found.non_manifold_vertices;
        report.turned_triangles += found.turned_triangles;
        report.places.insert(report.places.end(), found.places.begin(), found.places.end());
        if (sheets.crossings > 0 && cut_remaining_crossings(mesh)) continue;
        return;
    }
    throw DiagnosedFailure({.code = "orientation-contradicts"});
}

void face_outward(TriangleSoup& mesh, RepairReport& report) {
    const Surface whole = make_surface(mesh.points, mesh.triangles);
    const Components parts = connected_components(*whole.topology);
    std::vector<std::uint8_t> inward(parts.count(), 0);
    bool any = false;
    for (std::size_t i = 0; i < parts.count(); ++i) {
        std::vector<bool> keep(mesh.triangles.size());
        for (TriangleId t = 0; t < keep.size(); ++t) keep[t] = parts.of_triangle[t] == i;
        inward[i] = volume(parts.count() == 1 ? whole : select_triangles(whole, keep)) < 0.0;
        any = any || inward[i];
    }
    if (!any) return;
    for (TriangleId t = 0; t < mesh.triangles.size(); ++t)
        if (inward[parts.of_triangle[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    report.turned_inside_out = true;
}

}  // namespace vesselbench
