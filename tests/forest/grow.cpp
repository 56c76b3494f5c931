#include "tests/forest/grow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/forest/dice.h"

namespace vesselbench::forest {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Points of a line per diameter.
constexpr double kStep = 0.15;
/// The inlet is the largest end by this factor.
constexpr double kInletFactor = 1.2;
/// What a line is longer than its vessel, so that its end can be shaped [diameters].
constexpr double kBeyond = 1.3;

double squared_to_piece(const Vec3& p, const LinePoint& a, const LinePoint& b, double& radius) {
    const Vec3 axis = b.at - a.at;
    const double u =
        std::clamp((p - a.at).dot(axis) / std::max(axis.squaredNorm(), 1e-18), 0.0, 1.0);
    radius = a.radius + u * (b.radius - a.radius);
    return (p - a.at - u * axis).squaredNorm();
}

Eigen::AlignedBox3d box_of(const Line& line) {
    Eigen::AlignedBox3d box;
    for (const LinePoint& p : line) {
        box.extend(Vec3(p.at - Vec3::Constant(p.radius)));
        box.extend(Vec3(p.at + Vec3::Constant(p.radius)));
    }
    return box;
}

Vec3 start_direction(const Line& line) {
    return (line[1].at - line[0].at).normalized();
}

/// Direction in which a branch leaves a node.
Vec3 leaving(const Branch& branch, std::size_t node) {
    if (branch.from_node == node) return start_direction(branch.line);
    const Line& line = branch.line;
    return (line[line.size() - 2].at - line.back().at).normalized();
}

/// Distance from a common node at which a vessel keeps `gap` from another [mm].
double separation(double own, double other, double angle, double gap) {
    const double steep = std::max(std::sin(std::min(angle, 90.0 * kDegree)), 0.05);
    return 1.1 * (own + other + gap) / steep;
}

/// Distance from a common node at which a vessel's wall has left another [mm].
double wall_left(double own, double other, double angle) {
    const double flat = std::min(angle, 90.0 * kDegree);
    return (other + own * std::cos(flat)) / std::max(std::sin(flat), 0.05);
}

bool keeps_from_itself(const Line& line, double gap) {
    const std::vector<double> sums = abscissas(line);
    const double radius = line.front().radius;
    for (std::size_t i = 0; i < line.size(); ++i)
        for (std::size_t j = i + 1; j < line.size(); ++j)
            if (sums[j] - sums[i] > 6.0 * radius &&
                (line[i].at - line[j].at).norm() < 2.0 * radius + gap)
                return false;
    return true;
}

/// Grows a tree by furcating its terminal branches.
class Gardener {
public:
    explicit Gardener(const Plan& plan)
        : plan_(plan), dice_(plan.seed ^ 0x5eedf0e57ULL), thinnest_(0.5 * kThinnest * plan.trunk) {
        const double voxels =
            plan.kind == CaseKind::OpenSurface || plan.kind == CaseKind::ClosedSurface
                ? 0.8
                : std::max(1.0, 0.4 * plan.anisotropy);
        gap_ = voxels * 2.0 * thinnest_;
    }

    Tree run() {
        plant_trunk();
        std::vector<std::size_t> open = {1, 2};
        while (!open.empty() && ends() < plan_.ends) {
            std::vector<double> weights;
            for (const std::size_t b : open)
                weights.push_back(std::pow(tree_.branches[b].line.front().radius, 2.0));
            const std::size_t i = dice_.pick(weights), at = open[i];
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
            for (const std::size_t child : furcate(at)) open.push_back(child);
        }
        for (int i = 0; i < plan_.loops; ++i) add_loop();
        for (int i = 0; i < plan_.kisses; ++i) add_kiss();
        for (int i = 0; i < plan_.sacs; ++i) add_sac();
        return std::move(tree_);
    }

private:
    [[nodiscard]] int ends() const {
        return static_cast<int>(std::ranges::count_if(
            tree_.branches, [](const Branch& branch) { return !branch.to_node; }));
    }

    void plant_trunk() {
        const double radius = 0.5 * plan_.trunk;
        const Vec3 up = dice_.direction();
        tree_.nodes.push_back(node_at(Vec3::Zero(), radius, 0.5 * radius));
        Branch trunk;
        trunk.length = plan_.trunk * dice_.between(1.5, 8.0);
        trunk.line = wandering(dice_, {Vec3::Zero(), radius}, -up, trunk.length,
                               std::min(plan_.tortuosity, 0.3));
        extend(trunk.line, kBeyond * plan_.trunk);
        tree_.branches.push_back(std::move(trunk));
        while (tree_.branches.size() < 3) {
            tree_.branches.resize(1);
            grow_children(0, up, radius, radius / kInletFactor, 2);
        }
    }

    [[nodiscard]] Node node_at(const Vec3& at, double radius, double thin) const {
        return {.at = at, .reach = 4.0 * radius, .blend = 0.5 * thin};
    }

    /// Divides a terminal branch. \return the new terminal branches; none: it stays as it was
    std::vector<std::size_t> furcate(std::size_t index) {
        const Branch old = tree_.branches[index];
        const double diameter = 2.0 * old.line.front().radius;
        const double at =
            std::max(old.free_from + 0.8 * diameter, old.length * dice_.between(0.5, 1.0));
        if (at > old.length || diameter < 1.1 * 2.0 * thinnest_) return {};
        const LinePoint place = at_abscissa(old.line, at);
        const std::size_t node = tree_.nodes.size(), first = tree_.branches.size();
        tree_.nodes.push_back(node_at(place.at, place.radius, place.radius));
        Branch& branch = tree_.branches[index];
        branch.line = part_of(old.line, 0.0, at);
        branch.length = at;
        branch.to_node = node;
        const int wanted = 2 + static_cast<int>(dice_.pick({0.82, 0.14, 0.04}));
        const int most = std::min(wanted, plan_.ends - ends());
        grow_children(node, tangent_at(old.line, at), place.radius, 0.98 * place.radius,
                      std::max(most, 2));
        if (tree_.branches.size() < first + 2) {
            tree_.branches.resize(first);
            tree_.nodes.pop_back();
            tree_.branches[index] = old;
            return {};
        }
        std::vector<std::size_t> children;
        for (std::size_t b = first; b < tree_.branches.size(); ++b) children.push_back(b);
        return children;
    }

    std::vector<double> daughter_radii(double radius, double most, int count) {
        std::vector<double> shares = {1.0};
        while (static_cast<int>(shares.size()) < count) shares.push_back(dice_.between(0.35, 1.0));
        double sum = 0.0;
        for (const double share : shares) sum += std::pow(share, plan_.exponent);
        std::vector<double> radii;
        for (const double share : shares) {
            const double ideal = radius * share / std::pow(sum, 1.0 / plan_.exponent);
            radii.push_back(std::clamp(ideal * (1.0 + 0.05 * dice_.normal()), thinnest_, most));
        }
        return radii;
    }

    /// \param most radius of a daughter [mm]
    void grow_children(std::size_t node, const Vec3& along, double radius, double most, int count) {
        const std::vector<double> radii = daughter_radii(radius, most, count);
        const Vec3 side = dice_.across(along);
        for (int i = 0; i < count; ++i) {
            const double r = radii[static_cast<std::size_t>(i)];
            tree_.nodes[node].blend = std::min(tree_.nodes[node].blend, 0.5 * r);
            const double turn = 2.0 * std::numbers::pi * i / count;
            for (int attempt = 0; attempt < 14; ++attempt) {
                const double angle = std::clamp(
                    (20.0 + 55.0 * (1.0 - r / radius)) * dice_.between(0.6, 1.8), 12.0, 110.0);
                const Vec3 around = Eigen::AngleAxisd(turn + 0.3 * dice_.normal(), along) * side;
                const Vec3 direction =
                    std::cos(angle * kDegree) * along + std::sin(angle * kDegree) * around;
                if (grow_child(node, direction, r)) break;
            }
        }
    }

    bool grow_child(std::size_t node, const Vec3& direction, double radius) {
        static const std::vector<std::array<double, 2>> ranges = {
            {0.4, 1.0}, {1.0, 3.0}, {3.0, 10.0}, {10.0, 22.0}};
        const auto& [low, high] = ranges[dice_.pick({0.08, 0.17, 0.60, 0.15})];
        double curl = plan_.tortuosity;
        if (low >= 10.0 || dice_.chance(0.15)) curl = 0.5;
        Branch child;
        child.from_node = node;
        double free = 0.0;
        for (const Branch& other : tree_.branches)
            if (meets(other, node))
                free = std::max(free, free_from(other, node, direction, radius));
        child.free_from = free;
        child.length = free + 2.0 * radius * dice_.between(low, high);
        child.line =
            wandering(dice_, {tree_.nodes[node].at, radius}, direction, child.length, curl);
        extend(child.line, kBeyond * 2.0 * radius);
        if (!has_room(tree_, child.line, node, gap_)) return false;
        tree_.branches.push_back(std::move(child));
        return true;
    }

    [[nodiscard]] static double free_from(const Branch& other, std::size_t node,
                                          const Vec3& direction, double radius) {
        const double cosine = std::clamp(direction.dot(leaving(other, node)), -1.0, 1.0);
        const double thick =
            other.from_node == node ? other.line.front().radius : other.line.back().radius;
        return wall_left(radius, thick, std::acos(cosine));
    }

    /// Divides a branch in two. \return the node between them
    std::size_t split(std::size_t index, double s, double thin) {
        const LinePoint place = at_abscissa(tree_.branches[index].line, s);
        const std::size_t node = tree_.nodes.size();
        tree_.nodes.push_back(node_at(place.at, place.radius, thin));
        Branch second = tree_.branches[index];
        second.line = part_of(second.line, s, length_of(second.line));
        second.length -= s;
        second.from_node = node;
        second.free_from = 1.5 * place.radius;
        Branch& first = tree_.branches[index];
        first.line = part_of(first.line, 0.0, s);
        first.length = s;
        first.to_node = node;
        tree_.branches.push_back(std::move(second));
        return node;
    }

    /// Where a branch may be joined or touched: away from its ends. Negative: nowhere.
    double middle_of(const Branch& branch) {
        const double diameter = 2.0 * branch.line.front().radius;
        const double low = branch.free_from + 0.8 * diameter;
        const double high = branch.length - 1.5 * diameter;
        return low < high ? dice_.between(low, high) : -1.0;
    }

    std::size_t any_branch() {
        return static_cast<std::size_t>(
            dice_.whole(1, static_cast<int>(tree_.branches.size()) - 1));
    }

    /// Joins two branches by a third.
    void add_loop() {
        for (int attempt = 0; attempt < 300; ++attempt) {
            const std::size_t a = any_branch(), b = any_branch();
            const double s = middle_of(tree_.branches[a]), t = middle_of(tree_.branches[b]);
            if (a == b || s < 0.0 || t < 0.0) continue;
            const LinePoint from = at_abscissa(tree_.branches[a].line, s);
            const LinePoint to = at_abscissa(tree_.branches[b].line, t);
            const double apart = (to.at - from.at).norm();
            const double thick = from.radius + to.radius;
            if (apart < 2.5 * thick || apart > 12.0 * thick) continue;
            const double radius =
                std::max(thinnest_, dice_.between(0.5, 0.9) * std::min(from.radius, to.radius));
            const Line line = bridge(a, s, b, t, radius);
            if (!bridge_has_room(line, a, b)) continue;
            join(a, s, b, t, line);
            ++tree_.loops;
            return;
        }
    }

    [[nodiscard]] Line bridge(std::size_t a, double s, std::size_t b, double t,
                              double radius) const {
        const Line &first = tree_.branches[a].line, &second = tree_.branches[b].line;
        const Vec3 from = at_abscissa(first, s).at, to = at_abscissa(second, t).at;
        const Vec3 chord = to - from;
        const auto away = [&](const Vec3& tangent, const Vec3& towards) -> Vec3 {
            return (towards - 0.7 * tangent.dot(towards) * tangent).normalized();
        };
        const double pull = 0.4 * chord.norm();
        const Vec3 c1 = from + pull * away(tangent_at(first, s), chord);
        const Vec3 c2 = to + pull * away(tangent_at(second, t), -chord);
        const int steps = std::max(12, static_cast<int>(chord.norm() / (kStep * 2.0 * radius)));
        Line line;
        for (int i = 0; i <= steps; ++i) {
            const double u = static_cast<double>(i) / steps, v = 1.0 - u;
            line.push_back(
                {v * v * v * from + 3.0 * v * v * u * c1 + 3.0 * v * u * u * c2 + u * u * u * to,
                 radius});
        }
        return line;
    }

    [[nodiscard]] bool bridge_has_room(const Line& line, std::size_t a, std::size_t b) const {
        for (std::size_t k = 0; k < tree_.branches.size(); ++k)
            for (const LinePoint& p : line) {
                const auto near = [&](std::size_t own, const LinePoint& end) {
                    const double thick = tree_.branches[own].line.front().radius;
                    return k == own && (p.at - end.at).norm() < 2.2 * (thick + p.radius);
                };
                if (near(a, line.front()) || near(b, line.back())) continue;
                if (clearance(p, tree_.branches[k].line) < gap_) return false;
            }
        return keeps_from_itself(line, gap_);
    }

    void join(std::size_t a, double s, std::size_t b, double t, const Line& line) {
        const double radius = line.front().radius;
        Branch joint;
        joint.from_node = split(a, s, radius);
        joint.to_node = split(b, t, radius);
        joint.line = line;
        joint.length = length_of(line);
        joint.free_from = 1.2 * tree_.branches[a].line.back().radius;
        tree_.branches.push_back(std::move(joint));
    }

    /// Leads a terminal branch past another one, so that they touch.
    void add_kiss() {
        // an image cannot show a gap below a voxel: there they look joined
        const double gap =
            (is_image(plan_.kind) || plan_.kind == CaseKind::VoxelSurface ? 0.1 : 2.2) *
            edge_for(plan_, tree_);
        for (int attempt = 0; attempt < 400; ++attempt) {
            const std::size_t own = any_branch(), host = any_branch();
            const Branch &branch = tree_.branches[own], &other = tree_.branches[host];
            const double radius = branch.line.front().radius;
            if (branch.to_node || own == host || meets(other, branch.from_node)) continue;
            const double t = middle_of(other);
            if (t < 0.0 || branch.length < branch.free_from + 6.0 * radius) continue;
            const double apart = (at_abscissa(other.line, t).at - branch.line[0].at).norm();
            if (apart < 8.0 * radius || apart > 40.0 * radius) continue;
            if (kiss(own, host, t, gap)) return;
        }
    }

    bool kiss(std::size_t own, std::size_t host, double t, double gap) {
        Branch changed = tree_.branches[own];
        const Branch& other = tree_.branches[host];
        const double radius = changed.line.front().radius;
        const LinePoint touched = at_abscissa(other.line, t);
        const Vec3 along = tangent_at(other.line, t), out = dice_.across(along);
        const Vec3 start = changed.line[0].at, leave = start_direction(changed.line);
        Vec3 pass = (touched.at - start).normalized() + 0.7 * dice_.direction();
        pass = (pass - pass.dot(out) * out).normalized();
        double distance = touched.radius + radius + gap, found = 0.0;
        const double beyond = 2.0 * radius * dice_.between(2.0, 4.0);
        for (int round = 0; round < 6; ++round) {
            changed.line = passing(start, leave, touched.at + distance * out, pass, radius);
            extend(changed.line, beyond);
            found = std::numeric_limits<double>::infinity();
            for (const LinePoint& p : changed.line)
                found = std::min(found, clearance(p, other.line));
            distance += gap - found;
        }
        if (std::abs(found - gap) > 0.2 * gap) return false;
        changed.length = length_of(changed.line);
        extend(changed.line, kBeyond * 2.0 * radius);
        Tree without = tree_;
        // the new line replaces the old one, and its distance from the host is known
        const Vec3 nowhere = Vec3::Constant(1e6);
        for (const std::size_t b : {own, host})
            without.branches[b].line = {{nowhere, 1e-6}, {nowhere + leave, 1e-6}};
        if (!has_room(without, changed.line, changed.from_node, gap_)) return false;
        for (const LinePoint& p : changed.line)
            if (clearance(p, other.line) < 0.8 * gap) return false;
        tree_.branches[own] = std::move(changed);
        tree_.kisses.push_back({own, host, touched.at + touched.radius * out, gap});
        return true;
    }

    /// A curve from a place and direction to another (cubic Hermite).
    [[nodiscard]] static Line passing(const Vec3& from, const Vec3& leave, const Vec3& to,
                                      const Vec3& arrive, double radius) {
        const double reach = (to - from).norm();
        const int steps = std::max(16, static_cast<int>(1.2 * reach / (kStep * 2.0 * radius)));
        Line line;
        for (int i = 0; i <= steps; ++i) {
            const double u = static_cast<double>(i) / steps, u2 = u * u, u3 = u2 * u;
            line.push_back({(2.0 * u3 - 3.0 * u2 + 1.0) * from +
                                (u3 - 2.0 * u2 + u) * reach * leave + (3.0 * u2 - 2.0 * u3) * to +
                                (u3 - u2) * reach * arrive,
                            radius});
        }
        return line;
    }

    void add_sac() {
        for (int attempt = 0; attempt < 100; ++attempt) {
            const std::size_t host = any_branch();
            const Branch& branch = tree_.branches[host];
            const bool at_node = dice_.chance(0.4) && branch.to_node;
            const double s = at_node ? branch.length : middle_of(branch);
            if (s < 0.0) continue;
            const LinePoint place = at_abscissa(branch.line, s);
            const Vec3 along = tangent_at(branch.line, s);
            const Vec3 out = at_node ? along : dice_.across(along);
            Sac sac;
            sac.radius = place.radius * dice_.between(1.0, 2.2);
            sac.centre = place.at + out * (place.radius + sac.radius * dice_.between(0.5, 0.8));
            sac.blend = 0.4 * place.radius;
            if (!sac_has_room(sac, host, at_node)) continue;
            tree_.sacs.push_back(sac);
            return;
        }
    }

    [[nodiscard]] bool sac_has_room(const Sac& sac, std::size_t host, bool at_node) const {
        const Branch& branch = tree_.branches[host];
        for (std::size_t b = 0; b < tree_.branches.size(); ++b) {
            const Branch& other = tree_.branches[b];
            if (b == host) continue;
            // the daughters beside a sac leave it within its radius
            const bool beside = at_node && meets(other, *branch.to_node);
            Line line = other.line;
            if (beside)
                line =
                    part_of(line, std::min(2.5 * sac.radius, 0.9 * other.length), length_of(line));
            if (clearance({sac.centre, sac.radius}, line) < gap_) return false;
        }
        for (const Sac& other : tree_.sacs)
            if ((other.centre - sac.centre).norm() < other.radius + sac.radius + gap_) return false;
        return true;
    }

    const Plan& plan_;
    Dice dice_;
    double thinnest_;   ///< radius [mm]
    double gap_ = 0.0;  ///< between vessels that do not meet [mm]
    Tree tree_;
};

}  // namespace

Tree grow(const Plan& plan) {
    return Gardener(plan).run();
}

double clearance(const LinePoint& point, const Line& line) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        double radius = 0.0;
        const double squared = squared_to_piece(point.at, line[i], line[i + 1], radius);
        least = std::min(least, std::sqrt(squared) - radius);
    }
    return least - point.radius;
}

bool meets(const Branch& branch, std::size_t node) {
    return branch.from_node == node || branch.to_node == node;
}

double wall_area(const Tree& tree) {
    double area = 0.0;
    for (const Branch& branch : tree.branches)
        area += 2.0 * std::numbers::pi * branch.line.front().radius * branch.length;
    for (const Sac& sac : tree.sacs) area += 3.0 * std::numbers::pi * sac.radius * sac.radius;
    return area;
}

double thinnest_radius(const Tree& tree) {
    double least = std::numeric_limits<double>::infinity();
    for (const Branch& branch : tree.branches)
        for (const LinePoint& p : branch.line) least = std::min(least, p.radius);
    return least;
}

double edge_for(const Plan& plan, const Tree& tree) {
    constexpr double kTrianglesPerEdge2 = 2.8;  // flying edges' on a wall of area 1
    constexpr double kMostTriangles = 150'000.0;
    const double area = kTrianglesPerEdge2 * wall_area(tree);
    const double wanted = std::min(0.6 * thinnest_radius(tree), std::sqrt(area / plan.triangles));
    return std::max(wanted, std::sqrt(area / kMostTriangles));
}

void extend(Line& line, double length) {
    const LinePoint last = line.back();
    const Vec3 along = (last.at - line[line.size() - 2].at).normalized();
    const int steps = std::max(2, static_cast<int>(length / (kStep * 2.0 * last.radius)));
    for (int i = 1; i <= steps; ++i)
        line.push_back({last.at + along * length * i / steps, last.radius});
}

Line wandering(Dice& dice, const LinePoint& start, const Vec3& direction, double length,
               double curl) {
    const double diameter = 2.0 * start.radius, limit = curl / diameter;
    const int steps = std::max(6, static_cast<int>(std::ceil(length / (kStep * diameter))));
    const double step = length / steps, taper = dice.between(0.0, 0.08);
    Vec3 at = start.at, along = direction, bend = dice.across(along) * limit * dice.unit();
    Line line = {start};
    for (int i = 1; i <= steps; ++i) {
        bend += limit * 0.6 * std::sqrt(step / diameter) * dice.normal() * dice.across(along);
        bend -= along * along.dot(bend);
        if (bend.norm() > limit) bend *= limit / bend.norm();
        const Vec3 next = (along + step * bend).normalized();
        at += step * (along + next).normalized();
        along = next;
        line.push_back({at, start.radius * (1.0 - taper * i / steps)});
    }
    return line;
}

bool has_room(const Tree& tree, const Line& line, std::size_t node, double gap) {
    const Eigen::AlignedBox3d box = box_of(line);
    const Vec3 origin = tree.nodes[node].at, start = start_direction(line);
    for (const Branch& other : tree.branches) {
        if (box.exteriorDistance(Vec3(box_of(other.line).center())) >
            0.5 * box_of(other.line).diagonal().norm() + gap)
            continue;
        double apart = 0.0;
        Line rest = other.line;
        if (meets(other, node)) {
            const double cosine = std::clamp(start.dot(leaving(other, node)), -1.0, 1.0);
            const double thick = other.from_node == node ? rest.front().radius : rest.back().radius;
            apart = separation(line.front().radius, thick, std::acos(cosine), gap);
        }
        for (const LinePoint& p : line)
            if ((p.at - origin).norm() >= apart && clearance(p, rest) < gap) return false;
    }
    for (const Sac& sac : tree.sacs)
        if (clearance({sac.centre, sac.radius}, line) < gap) return false;
    return keeps_from_itself(line, gap);
}

}  // namespace vesselbench::forest
