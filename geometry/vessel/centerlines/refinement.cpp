#include "geometry/vessel/centerlines/refinement.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "geometry/kernel/robust.h"
#include "geometry/kernel/statistics.h"
#include "geometry/vessel/centerlines/line_smoothing.h"
#include "geometry/vessel/centerlines/strands.h"

namespace vesselbench {
namespace {

constexpr double kTangentWindow = 1.5;  ///< half width of the fits that yield directions, in radii
constexpr double kPointWindow = 1.2;    ///< half width of the fits that smooth points, in radii
constexpr int kRounds = 8;
constexpr int kCoarseRounds = 4;  ///< with a softer fit, to get close
constexpr int kExtendAfter = 7;   ///< round after which blind ends are extended
constexpr double kCovered =
    0.9;  ///< a point is in another vessel if it is within this fraction of its sphere
constexpr double kEnoughWall = 0.5;  ///< fraction of directions with wall that a section needs
constexpr double kMostNoise = 1.08;  ///< largest ratio of the section's radius to the distance of
                                     ///< the nearest wall point

constexpr double kClosureDepth = 1.5;  ///< depths within this many radii of an end are unreliable

enum class Hold : std::uint8_t {
    Free,
    Fixed,    ///< an opening's centre
    Covered,  ///< inside another vessel at a furcation
    Extended  ///< the last stretch to a blind end
};

/// A strand being moved from voxels to the middle of its vessel.
struct Work {
    Strand strand;
    Line line;
    std::vector<Hold> hold;          ///< #points
    std::vector<std::size_t> marks;  ///< indices of the nodes along the strand
    std::vector<std::size_t> nodes;  ///< the nodes themselves; #marks
};

std::size_t first_node(const RoughGraph& rough, const StrandPiece& piece) {
    const CenterlineBranch& b = rough.graph.branches[piece.branch];
    return piece.reversed ? b.end_node : b.start_node;
}

std::size_t last_node(const RoughGraph& rough, const StrandPiece& piece) {
    return first_node(rough, {piece.branch, !piece.reversed});
}

/// Index of the first point whose path to the start is longer than its radius: depths before it are
/// those of the closure.
std::size_t behind_closure(const Line& line) {
    double way = 0.0;
    const std::size_t most = line.points.size() / 2;
    for (std::size_t i = 0; i < most; ++i) {
        if (i > 0) way += (line.points[i] - line.points[i - 1]).norm();
        if (way > kClosureDepth * line.radii[i]) return i;
    }
    return most;
}

void reverse(Line& line) {
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.radii.begin(), line.radii.end());
    std::reverse(line.weights.begin(), line.weights.end());
}

/// Repairs the start of a piece that begins at a tip: an opening gets a straight line to its centre
/// and the vessel's radius, a blind end is cut back to its last full sphere.
void mend_tip(Line& piece, NodeKind kind) {
    const std::size_t k = behind_closure(piece);
    if (kind == NodeKind::Opening) {
        for (std::size_t i = 1; i < k; ++i) {
            const double f = static_cast<double>(i) / static_cast<double>(k);
            piece.points[i] = (1.0 - f) * piece.points[0] + f * piece.points[k];
        }
        for (std::size_t i = 0; i < k; ++i) piece.radii[i] = piece.radii[k];
    } else if (kind == NodeKind::Blind) {
        const auto n = static_cast<std::ptrdiff_t>(k);
        piece.points.erase(piece.points.begin(), piece.points.begin() + n);
        piece.radii.erase(piece.radii.begin(), piece.radii.begin() + n);
        piece.weights.erase(piece.weights.begin(), piece.weights.begin() + n);
    }
}

/// One branch of the rough graph in the strand's direction, with repaired tips.
Line rough_piece(const RoughGraph& rough, const StrandPiece& piece, bool first, bool last) {
    const CenterlineBranch& b = rough.graph.branches[piece.branch];
    Line line{b.points, b.radii, std::vector<double>(b.points.size(), 1.0), false};
    if (piece.reversed) reverse(line);
    if (first) mend_tip(line, rough.kinds[first_node(rough, piece)]);
    if (last) {
        reverse(line);
        mend_tip(line, rough.kinds[last_node(rough, piece)]);
        reverse(line);
    }
    return line;
}

void append(Line& to, const Line& from, std::size_t begin) {
    for (std::size_t i = begin; i < from.points.size(); ++i) {
        to.points.push_back(from.points[i]);
        to.radii.push_back(from.radii[i]);
        to.weights.push_back(1.0);
    }
}

Line part_of(const Line& line, std::size_t begin, std::size_t end) {
    Line part;
    for (std::size_t i = begin; i <= end; ++i) {
        part.points.push_back(line.points[i % line.points.size()]);
        part.radii.push_back(line.radii[i % line.points.size()]);
        part.weights.push_back(1.0);
    }
    return part;
}

/// Smooths the voxel steps, keeping the ends of an open line in place.
void smooth_steps(Line& line, double voxel) {
    const Vec3 front = line.points.front();
    const Vec3 back = line.points.back();
    for (int round = 0; round < 2; ++round) {
        const auto fits = fit_line(line, kTangentWindow, 5.0 * voxel);
        for (std::size_t i = 0; i < fits.size(); ++i) line.points[i] = fits[i].point;
        if (line.closed) continue;
        line.points.front() = front;
        line.points.back() = back;
    }
}

Work start_work(const RoughGraph& rough, const Strand& strand, double spacing) {
    Work work;
    work.strand = strand;
    Line whole;
    std::vector<std::size_t> marks{0};
    for (std::size_t p = 0; p < strand.pieces.size(); ++p) {
        const bool last = p + 1 == strand.pieces.size();
        const Line piece =
            rough_piece(rough, strand.pieces[p], p == 0 && !strand.closed, last && !strand.closed);
        append(whole, piece, p == 0 ? 0 : 1);
        marks.push_back(whole.points.size() - 1);
        work.nodes.push_back(first_node(rough, strand.pieces[p]));
    }
    work.nodes.push_back(last_node(rough, strand.pieces.back()));
    whole.closed = strand.closed;
    if (strand.closed) {
        whole.points.pop_back();
        whole.radii.pop_back();
        whole.weights.pop_back();
    }
    smooth_steps(whole, rough.voxel);
    for (std::size_t p = 0; p + 1 < marks.size(); ++p) {
        const Line piece = resampled(part_of(whole, marks[p], marks[p + 1]), spacing, 5);
        work.marks.push_back(p == 0 ? 0 : work.line.points.size() - 1);
        append(work.line, piece, p == 0 ? 0 : 1);
    }
    work.marks.push_back(work.line.points.size() - 1);
    work.line.closed = strand.closed;
    if (strand.closed) {
        work.line.points.pop_back();
        work.line.radii.pop_back();
        work.line.weights.pop_back();
    }
    work.hold.assign(work.line.points.size(), Hold::Free);
    return work;
}

bool contains(const Strand& strand, std::size_t branch) {
    return std::any_of(strand.pieces.begin(), strand.pieces.end(),
                       [&](const StrandPiece& p) { return p.branch == branch; });
}

/// True if p lies in a sphere of a branch at the node that does not belong to the strand.
bool in_other_vessel(const RoughGraph& rough, const Strand& strand, std::size_t node,
                     const Vec3& p) {
    for (const std::size_t b : rough.graph.nodes[node].branches) {
        if (contains(strand, b)) continue;
        const CenterlineBranch& other = rough.graph.branches[b];
        for (std::size_t i = 0; i < other.points.size(); ++i) {
            if ((other.points[i] - p).norm() < kCovered * other.radii[i]) return true;
        }
    }
    return false;
}

/// Constrains an end of the strand: an opening's centre is fixed; at a furcation, the wall does not
/// move the points inside the other vessels.
void hold_end(const RoughGraph& rough, Work& work, bool at_front) {
    const std::size_t n = work.line.points.size();
    const std::size_t node = at_front ? work.nodes.front() : work.nodes.back();
    const auto index = [&](std::size_t k) { return at_front ? k : n - 1 - k; };
    if (rough.kinds[node] == NodeKind::Opening) {
        work.hold[index(0)] = Hold::Fixed;
        work.line.weights[index(0)] = 20.0;
    }
    if (rough.kinds[node] != NodeKind::Furcation) return;
    for (std::size_t k = 0; k < n * 4 / 5; ++k) {
        if (k > 0 && !in_other_vessel(rough, work.strand, node, work.line.points[index(k)])) break;
        work.hold[index(k)] = Hold::Covered;
        work.line.weights[index(k)] = 0.02;
    }
}

/// Moves every free point to the middle of its section.
void centre_points(Work& work, const WallSections& wall, double softness) {
    const auto fits = fit_line(work.line, kTangentWindow, 0.0);
    const auto centre = [&](std::size_t i) {
        if (work.hold[i] == Hold::Covered || work.hold[i] == Hold::Extended) return;
        const double before = work.line.radii[i];
        const LinePlace place{fits[i].point, fits[i].tangent, fits[i].curvature, before};
        const WallSection section = wall.at(place, softness);
        if (section.covered < kEnoughWall) {
            if (work.hold[i] == Hold::Free) {
                work.line.points[i] = fits[i].point;
                work.line.weights[i] = 0.1;
            }
            return;
        }
        work.line.radii[i] = std::clamp(section.radius, 0.7 * before, 1.4 * before);
        if (work.hold[i] == Hold::Fixed) return;
        work.line.points[i] = section.centre;
        work.line.weights[i] = section.covered * section.covered;
    };
    tbb::parallel_for(std::size_t{0}, work.line.points.size(), centre);
}

void smooth_points(Work& work) {
    const auto fits = fit_line(work.line, kPointWindow, 0.0);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        if (work.hold[i] != Hold::Fixed) work.line.points[i] = fits[i].point;
        if (work.hold[i] == Hold::Free) work.line.radii[i] = fits[i].radius;
    }
}

/// Redistributes the points of every branch of a strand evenly in local radii; their number is
/// kept.
void space_evenly(Work& work) {
    const Line before = work.line;
    for (std::size_t m = 0; m + 1 < work.marks.size(); ++m) {
        const std::size_t first = work.marks[m];
        const std::size_t count = work.marks[m + 1] - first + 1;
        const Line even = resampled(part_of(before, first, work.marks[m + 1]), 1e6, count);
        for (std::size_t i = 1; i + 1 < count; ++i) {
            work.line.points[first + i] = even.points[i];
            work.line.radii[first + i] = even.radii[i];
        }
    }
}

/// Extends a blind end along its direction as long as the section keeps half of its radius and the
/// end wall is not near.
void extend_back(Work& work, const WallSections& wall, double spacing) {
    Line& line = work.line;
    const double size = line.radii.back();
    const auto back = static_cast<std::size_t>(std::ceil(1.5 / spacing));
    for (int step = 0; step < static_cast<int>(8.0 / spacing); ++step) {
        const std::size_t n = line.points.size();
        const Vec3 ahead =
            (line.points[n - 1] - line.points[n - 1 - std::min(n - 1, back)]).normalized();
        const double stride = spacing * size;
        if (wall.free_way(line.points.back(), ahead) < stride + 0.25 * size) return;
        const LinePlace place{line.points.back() + stride * ahead, ahead, Vec3::Zero(), size};
        const WallSection section = wall.at(place, 0.1);
        if (section.covered < 0.75 || section.radius < 0.5 * size) return;
        line.points.push_back(0.5 * (place.point + section.centre));
        line.radii.push_back(section.radius);
        line.weights.push_back(1.0);
        work.hold.push_back(Hold::Extended);
        work.marks.back() = line.points.size() - 1;
    }
}

void reverse(Work& work) {
    reverse(work.line);
    std::reverse(work.hold.begin(), work.hold.end());
    std::reverse(work.marks.begin(), work.marks.end());
    std::reverse(work.nodes.begin(), work.nodes.end());
    for (std::size_t& m : work.marks) m = work.line.points.size() - 1 - m;
}

void extend_blind_ends(const RoughGraph& rough, Work& work, const WallSections& wall,
                       double spacing) {
    if (work.strand.closed) return;
    if (rough.kinds[work.nodes.back()] == NodeKind::Blind) extend_back(work, wall, spacing);
    if (rough.kinds[work.nodes.front()] != NodeKind::Blind) return;
    reverse(work);
    extend_back(work, wall, spacing);
    reverse(work);
}

/// Leads the covered stretch at the front of a strand from its node to the point where the strand
/// leaves the other vessels, in the direction it has there.
void lead_from_node(Work& work, const Vec3& node) {
    std::size_t exit = 0;
    while (exit + 1 < work.hold.size() && work.hold[exit] == Hold::Covered) ++exit;
    if (exit == 0) return;
    const Line rest = part_of(work.line, exit, work.line.points.size() - 1);
    const Vec3 end = work.line.points[exit];
    const double span = (end - node).norm();
    const Vec3 slope = span * fit_line(rest, kTangentWindow, 0.0).front().tangent;
    for (std::size_t i = 0; i < exit; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(exit);
        const Vec3 straight = (1.0 - t) * node + t * end;
        // Quadratic Bezier-like blend: leaves the node freely, arrives with the strand's slope.
        work.line.points[i] = straight + t * t * (1.0 - t) * ((end - node) - slope);
    }
}

/// Radii from the sections, limited by the nearest wall; inside other vessels from the wall alone.
void limit_radii(std::vector<Work>& works, const WallSections& wall) {
    std::vector<std::vector<double>> nearest(works.size());
    std::vector<double> ratios;
    for (std::size_t w = 0; w < works.size(); ++w) {
        const Line& line = works[w].line;
        nearest[w].resize(line.points.size());
        tbb::parallel_for(std::size_t{0}, line.points.size(),
                          [&](std::size_t i) { nearest[w][i] = wall.distance(line.points[i]); });
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            if (works[w].hold[i] == Hold::Free) ratios.push_back(line.radii[i] / nearest[w][i]);
        }
    }
    const double noise = std::clamp(median(ratios), 1.0, kMostNoise);
    for (std::size_t w = 0; w < works.size(); ++w) {
        for (std::size_t i = 0; i < nearest[w].size(); ++i) {
            const double limit = noise * nearest[w][i];
            double& r = works[w].line.radii[i];
            const bool section = works[w].hold[i] == Hold::Free || works[w].hold[i] == Hold::Fixed;
            r = section ? std::min(r, limit) : limit;
        }
    }
}

CenterlineGraph assemble(const RoughGraph& rough, const std::vector<Work>& works) {
    CenterlineGraph graph;
    graph.nodes = rough.graph.nodes;
    for (CenterlineNode& node : graph.nodes) node.branches.clear();
    for (const Work& work : works) {
        for (std::size_t m = 0; m + 1 < work.marks.size(); ++m) {
            const Line part = part_of(work.line, work.marks[m], work.marks[m + 1]);
            CenterlineBranch branch{work.nodes[m], work.nodes[m + 1], part.points, part.radii};
            graph.nodes[branch.start_node].branches.push_back(graph.branches.size());
            graph.nodes[branch.end_node].branches.push_back(graph.branches.size());
            graph.branches.push_back(std::move(branch));
        }
    }
    return graph;
}

/// Moves one point to a place, and its neighbours along with it, less the farther away they are.
void pull(Line& line, std::size_t at, const Vec3& to) {
    const Vec3 shift = to - line.points[at];
    const double reach = 2.0 * line.radii[at];
    if (!(shift.norm() > 0.0)) return;
    const Vec3 from = line.points[at];
    for (Vec3& p : line.points) p += biweight((p - from).norm(), reach) * shift;
    line.points[at] = to;
}

/// Moves each node to the strand that passes through it, else to the strand that ends there, and
/// makes all branches meet it.
void place_nodes(std::vector<Work>& works, CenterlineGraph& nodes) {
    std::vector<int> rank(nodes.nodes.size(), 0);
    for (const Work& work : works) {
        for (std::size_t m = 0; m < work.marks.size(); ++m) {
            const bool through = work.strand.closed || (m > 0 && m + 1 < work.marks.size());
            const int own = through ? 2 : 1;
            if (rank[work.nodes[m]] >= own) continue;
            rank[work.nodes[m]] = own;
            const std::size_t i = work.marks[m] % work.line.points.size();
            nodes.nodes[work.nodes[m]].position = work.line.points[i];
        }
    }
    for (Work& work : works) {
        for (std::size_t m = 0; m < work.marks.size(); ++m) {
            const std::size_t i = work.marks[m] % work.line.points.size();
            const Vec3& node = nodes.nodes[work.nodes[m]].position;
            const bool through = work.strand.closed || (m > 0 && m + 1 < work.marks.size());
            if (through) pull(work.line, i, node);
            work.line.points[i] = node;
        }
        if (work.strand.closed) continue;
        lead_from_node(work, work.line.points.front());
        reverse(work);
        lead_from_node(work, work.line.points.front());
        reverse(work);
    }
}

}  // namespace

CenterlineGraph refine(const RoughGraph& rough, const WallSections& wall, double spacing,
                       const Progress& progress) {
    std::vector<Work> works;
    for (const Strand& strand : find_strands(rough.graph)) {
        works.push_back(start_work(rough, strand, spacing));
        if (strand.closed) continue;
        hold_end(rough, works.back(), true);
        hold_end(rough, works.back(), false);
    }
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t w = 0; w < works.size(); ++w) {
            Work& work = works[w];
            const double of_round = static_cast<double>(w) / static_cast<double>(works.size());
            progress.report((round + of_round) / kRounds, "centring the lines");
            centre_points(work, wall, round < kCoarseRounds ? 0.1 : 0.05);
            smooth_points(work);
            if (round % 2 == 1 && round + 1 < kExtendAfter) space_evenly(work);
            if (round + 1 == kExtendAfter) extend_blind_ends(rough, work, wall, spacing);
        }
    }
    RoughGraph placed = rough;
    place_nodes(works, placed.graph);
    limit_radii(works, wall);
    CenterlineGraph graph = assemble(placed, works);
    for (CenterlineNode& node : graph.nodes) {
        if (node.branches.empty()) continue;
        const CenterlineBranch& b = graph.branches[node.branches.front()];
        const bool at_start =
            (b.points.front() - node.position).norm() <= (b.points.back() - node.position).norm();
        node.radius = at_start ? b.radii.front() : b.radii.back();
    }
    return graph;
}

}  // namespace vesselbench
