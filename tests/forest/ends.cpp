#include "tests/forest/ends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/forest/dice.h"
#include "tests/forest/grow.h"

namespace vesselbench::forest {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// A vessel shows in an image if it is this many pixels and slice distances thick [-].
constexpr double kPixels = 2.5;
constexpr double kSlices = 1.2;
/// Sections of its own that an end needs so that it has to be opened [diameters].
constexpr double kOwnSections = 0.5;

std::vector<double> kind_weights(CaseKind kind, bool trunk) {
    if (kind == CaseKind::OpenSurface)
        return trunk ? std::vector{0.50, 0.31, 0.19, 0.0, 0.0}
                     : std::vector{0.40, 0.25, 0.15, 0.08, 0.12};
    if (kind == CaseKind::ClosedSurface) return {0.25, 0.15, 0.0, 0.0, 0.60};
    return {0.45, 0.0, 0.0, 0.0, 0.55};
}

/// First abscissa at which a branch has left the branches it starts from.
/// \param share of its own radius that has to be outside: 0 its line, 1 its wall
double left_at(const Tree& tree, const Branch& branch, double share) {
    const double step = 0.02 * branch.length;
    for (double s = 0.0; s < branch.length; s += step) {
        const LinePoint p = at_abscissa(branch.line, s);
        const bool inside = std::ranges::any_of(tree.branches, [&](const Branch& other) {
            return &other != &branch && !other.ghost && meets(other, branch.from_node) &&
                   clearance({p.at, share * p.radius}, other.line) < 0.0;
        });
        if (!inside) return s;
    }
    return branch.length;
}

class EndMaker {
public:
    EndMaker(Tree& tree, const Plan& plan)
        : tree_(tree), plan_(plan), dice_(plan.seed ^ 0xe9d5ULL), edge_(edge_for(plan, tree)) {}

    void run() {
        if (plan_.border && is_image(plan_.kind)) put_border();
        const std::size_t count = tree_.branches.size();
        for (std::size_t b = 0; b < count; ++b) {
            if (tree_.branches[b].to_node) continue;
            shape(b);
        }
        for (Branch& branch : tree_.branches) branch.free_from = left_at(tree_, branch, 0.0);
        if (is_image(plan_.kind) || plan_.kind == CaseKind::VoxelSurface) mark_resolved();
        for (std::size_t b = 0; b < count; ++b)
            if (tree_.branches[b].end) mark_optional(tree_.branches[b]);
    }

private:
    void shape(std::size_t b) {
        Branch& branch = tree_.branches[b];
        End end;
        end.radius = at_abscissa(branch.line, branch.length).radius;
        end.inlet = b == 0;
        end.kind = static_cast<EndKind>(dice_.pick(kind_weights(plan_.kind, b == 0)));
        end.place = at_abscissa(branch.line, branch.length).at;
        end.direction = tangent_at(branch.line, branch.length);
        end.whole_to = branch.length;
        if (b == 0 && tree_.border) end.kind = EndKind::Border;
        const double tilt = dice_.between(15.0, 50.0) * kDegree;
        if (end.kind == EndKind::Oblique &&
            branch.length - end.radius * std::tan(tilt) < branch.free_from + 0.2 * end.radius)
            end.kind = EndKind::Flat;
        if (end.kind == EndKind::Furcation && !add_ghosts(b, end)) end.kind = EndKind::Flat;
        finish(tree_.branches[b], end, tilt);
    }

    void finish(Branch& branch, End end, double tilt) {
        if (end.kind == EndKind::Flat) end.rim_normal = end.direction;
        if (end.kind == EndKind::Oblique) {
            end.rim_normal =
                std::cos(tilt) * end.direction + std::sin(tilt) * dice_.across(end.direction);
            end.whole_to -= end.radius * std::tan(tilt);
        }
        if (end.kind == EndKind::Ragged) {
            end.ragged = end.radius * dice_.between(0.2, 1.0);
            end.whole_to -= 0.5 * end.ragged + edge_;
        }
        if (end.kind == EndKind::Rounded) end.whole_to -= end.radius;
        if (end.kind == EndKind::Border) {
            end.rim_normal = tree_.border->normal();
            const double cosine = end.rim_normal.dot(end.direction);
            end.whole_to -= end.radius * std::sqrt(1.0 - cosine * cosine) / cosine;
        }
        branch.end = end;
    }

    /// Two vessels that leave the end, to be cut in the place where they do.
    bool add_ghosts(std::size_t b, End& end) {
        const Branch host = tree_.branches[b];
        const double radius = end.radius;
        if (host.length < host.free_from + 4.0 * radius) return false;
        const std::size_t node = tree_.nodes.size();
        Tree without = tree_;
        without.nodes.push_back({.at = end.place, .reach = 4.0 * radius, .blend = 0.3 * radius});
        without.branches[b].line = part_of(host.line, 0.0, host.length - 3.0 * radius);
        const Vec3 side = dice_.across(end.direction);
        std::vector<Branch> ghosts;
        for (const double sign : {-1.0, 1.0}) {
            const double angle = dice_.between(30.0, 50.0) * kDegree;
            Branch ghost;
            ghost.ghost = true;
            ghost.from_node = node;
            ghost.line = {{end.place, 0.75 * radius}};
            const Vec3 along = std::cos(angle) * end.direction + sign * std::sin(angle) * side;
            ghost.line.push_back({end.place + 0.2 * radius * along, 0.75 * radius});
            extend(ghost.line, 3.0 * radius);
            ghost.length = length_of(ghost.line);
            if (!has_room(without, ghost.line, node, 0.5 * radius)) return false;
            ghosts.push_back(std::move(ghost));
        }
        tree_.nodes.push_back(without.nodes.back());
        tree_.branches[b].line = part_of(host.line, 0.0, host.length);
        tree_.branches[b].ghost_node = node;
        for (Branch& ghost : ghosts) tree_.branches.push_back(std::move(ghost));
        end.rim_normal = end.direction;
        end.place += end.direction * radius * dice_.between(0.25, 0.7);
        end.whole_to -= 0.3 * radius;
        return true;
    }

    /// Lets the image end where the trunk does, if nothing else reaches as far.
    void put_border() {
        const Branch& trunk = tree_.branches[0];
        const Vec3 along = tangent_at(trunk.line, trunk.length);
        Eigen::Index axis = 0;
        along.cwiseAbs().maxCoeff(&axis);
        const Vec3 normal = Vec3::Unit(axis) * (along[axis] > 0.0 ? 1.0 : -1.0);
        if (normal.dot(along) < std::cos(45.0 * kDegree)) return;
        const Vec3 place = at_abscissa(trunk.line, trunk.length).at;
        for (std::size_t b = 1; b < tree_.branches.size(); ++b)
            for (const LinePoint& p : tree_.branches[b].line)
                if ((p.at - place).dot(normal) + p.radius > -0.1 * plan_.trunk) return;
        for (const Sac& sac : tree_.sacs)
            if ((sac.centre - place).dot(normal) + sac.radius > -0.1 * plan_.trunk) return;
        tree_.border = Eigen::Hyperplane<double, 3>(normal, place);
    }

    /// What lies beyond a vessel too thin for the image does not show either.
    void mark_resolved() {
        const Voxels voxels = voxels_for(plan_, tree_);
        const double least = std::max(kPixels * voxels.pixel, kSlices * voxels.slice);
        std::vector<bool> reached(tree_.nodes.size(), false);
        reached[tree_.branches[0].from_node] = true;
        for (Branch& branch : tree_.branches) branch.resolved = false;
        for (bool more = true; more;) {
            more = false;
            for (Branch& branch : tree_.branches) {
                const bool thick = 2.0 * branch.line.back().radius >= least;
                const bool here =
                    reached[branch.from_node] || (branch.to_node && reached[*branch.to_node]);
                if (branch.resolved || !thick || !here) continue;
                branch.resolved = more = true;
                reached[branch.from_node] = true;
                if (branch.to_node) reached[*branch.to_node] = true;
            }
        }
    }

    void mark_optional(Branch& branch) {
        End& end = *branch.end;
        if (end.inlet) return;
        const auto say = [&](const char* why) {
            end.optional = true;
            end.why = why;
        };
        const double own = end.whole_to - left_at(tree_, branch, 1.0);
        if (!branch.resolved)
            say("too thin for the image");
        else if (own < 2.0 * kOwnSections * end.radius)
            say("a stub with less than half a diameter of whole sections");
        else if (plan_.kind == CaseKind::OpenSurface && end.kind == EndKind::Rounded)
            say("closed in the surface, whose other ends are open");
    }

    Tree& tree_;
    const Plan& plan_;
    Dice dice_;
    double edge_;
};

/// The part of a vessel in which its end is cut.
std::vector<Line> tails(const Tree& tree, const Branch& branch) {
    const double from = std::max(0.0, branch.length - 3.0 * branch.end->radius);
    std::vector<Line> found = {part_of(branch.line, from, length_of(branch.line))};
    if (branch.ghost_node)
        for (const Branch& other : tree.branches)
            if (other.ghost && other.from_node == *branch.ghost_node) found.push_back(other.line);
    return found;
}

/// Of a rim around an end: how far it lies beyond the end's plane [mm].
double ragged_height(const End& end, const Vec3& p) {
    if (end.ragged == 0.0) return 0.0;
    const Vec3 u = end.direction.unitOrthogonal(), v = end.direction.cross(u);
    const Vec3 d = p - end.place;
    const double angle = std::atan2(d.dot(v), d.dot(u));
    return 0.25 * end.ragged *
           (std::sin(3.0 * angle + end.radius) + 0.6 * std::sin(7.0 * angle) +
            0.4 * std::sin(13.0 * angle));
}

}  // namespace

Eigen::AlignedBox3d box_of(const Tree& tree) {
    Eigen::AlignedBox3d box;
    for (const Branch& branch : tree.branches)
        for (const LinePoint& p : branch.line) {
            box.extend(Vec3(p.at - Vec3::Constant(p.radius)));
            box.extend(Vec3(p.at + Vec3::Constant(p.radius)));
        }
    return box;
}

Voxels voxels_for(const Plan& plan, const Tree& tree) {
    constexpr double kMostVoxels = 16e6;
    constexpr double kMostTriangles = 150'000.0, kTrianglesPerPixel2 = 3.0;
    std::vector<double> diameters;
    for (const Branch& branch : tree.branches)
        if (!branch.ghost) diameters.push_back(2.0 * branch.line.back().radius);
    std::ranges::sort(diameters);
    const double usual = diameters[diameters.size() * 2 / 5];
    if (plan.kind == CaseKind::VoxelSurface) {
        const double pixel =
            std::max(diameters.front() / 4.0,
                     std::sqrt(kTrianglesPerPixel2 * wall_area(tree) / kMostTriangles));
        return {pixel, pixel};
    }
    const double volume = box_of(tree).volume();
    double anisotropy = plan.anisotropy;
    const double wanted = std::min(diameters.front() / 3.0, usual / (kSlices * anisotropy));
    const double possible = std::cbrt(volume / (kMostVoxels * anisotropy));
    const double pixel = std::max(wanted, possible);
    return {pixel, pixel * anisotropy};
}

void form_ends(Tree& tree, const Plan& plan) {
    EndMaker(tree, plan).run();
}

Line shaping_line(const Branch& branch) {
    if (!branch.end || branch.end->kind != EndKind::Rounded) return branch.line;
    return part_of(branch.line, 0.0,
                   std::max(branch.length - branch.end->radius, 0.01 * branch.length));
}

bool is_at_end(const Tree& tree, const Branch& branch, const Vec3& p) {
    const End& end = *branch.end;
    if ((p - end.place).norm() > 6.0 * end.radius) return false;
    return std::ranges::any_of(tails(tree, branch), [&](const Line& line) {
        return clearance({p, 0.15 * end.radius}, line) < 0.0;
    });
}

bool is_cut_away(const Tree& tree, const Branch& branch, const Vec3& p) {
    const End& end = *branch.end;
    const bool flat = end.kind != EndKind::Ragged;
    if (end.kind == EndKind::Rounded || end.kind == EndKind::Border) return false;
    const double height = (p - end.place).dot(flat ? end.rim_normal : end.direction);
    return height > ragged_height(end, p) && is_at_end(tree, branch, p);
}

}  // namespace vesselbench::forest
