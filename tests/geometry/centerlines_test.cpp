#include "geometry/vessel/centerlines/centerlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/formats/centerline_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/simple_point.h"
#include "geometry/kernel/statistics.h"
#include "geometry/phantoms/imaging.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A shape whose true centerline is known.
struct Known {
    ImplicitShape shape;
    Eigen::AlignedBox3d box;
    /// Distance [mm] of a point to the true line and the line's direction; negative distance where
    /// the point is too near to an end or a furcation to be judged.
    std::function<std::pair<double, Vec3>(const Vec3&)> truth;
    double radius = 1.0;
};

Known tube() {
    const double r = 3.0, length = 40.0;
    return {[=](const Vec3& p) {
                return capsule(p, Vec3::Zero(), {0, 0, length}, r);
            },
            {Vec3(-3.77, -3.71, -3.9), Vec3(3.8, 3.9, length + 4)},
            [=](const Vec3& p) {
                const bool judged = p.z() > 0.0 && p.z() < length;
                return std::pair(judged ? std::hypot(p.x(), p.y()) : -1.0, Vec3(0, 0, 1));
            },
            r};
}

Known torus() {
    const double r = 3.0, ring = 10.0;
    return {[=](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - r; },
            {Vec3(-13.77, -13.71, -3.9), Vec3(13.8, 13.9, 4)},
            [=](const Vec3& p) {
                return std::pair(std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()),
                                 Vec3(-p.y(), p.x(), 0).normalized());
            },
            r};
}

Known y_shape() {
    const double r = 2.5, length = 25.0;
    const std::array<Vec3, 3> ways = {Vec3(0, 0, -1), Vec3(std::sin(0.7), 0, std::cos(0.7)),
                                      Vec3(-std::sin(0.7), 0, std::cos(0.7))};
    return {[=](const Vec3& p) {
                double d = 1e9;
                for (const Vec3& w : ways) d = std::min(d, capsule(p, Vec3::Zero(), length * w, r));
                return d;
            },
            {Vec3(-19.77, -3.71, -28.9), Vec3(19.8, 3.9, 23)},
            [=](const Vec3& p) {
                const Vec3 way = *std::max_element(
                    ways.begin(), ways.end(),
                    [&](const Vec3& a, const Vec3& b) { return a.dot(p) < b.dot(p); });
                const bool judged = way.dot(p) < length && p.norm() > 2.0 * r;
                return std::pair(judged ? (p - way.dot(p) * way).norm() : -1.0, way);
            },
            r};
}

Known rotated(const Known& known) {
    const Eigen::Matrix3d R = skew_rotation();
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 8; ++k)
        box.extend(R * known.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
    return {[=](const Vec3& p) { return known.shape(R.transpose() * p); }, box,
            [=](const Vec3& p) {
                const auto [distance, way] = known.truth(R.transpose() * p);
                return std::pair(distance, Vec3(R * way));
            },
            known.radius};
}

/// Mean and 95th percentile.
struct Spread {
    double mean = 0.0;
    double high = 0.0;

    explicit Spread(std::vector<double> values) {
        REQUIRE(values.size() > 20);
        std::sort(values.begin(), values.end());
        for (const double v : values) mean += v / static_cast<double>(values.size());
        high = values[values.size() * 95 / 100];
    }
};

struct Errors {
    std::vector<double> position, radius;  ///< in radii
    std::vector<double> direction;         ///< [deg]
};

Errors errors_of(const CenterlineGraph& graph, const Known& known) {
    Errors e;
    for (const CenterlineBranch& b : graph.branches) {
        const auto s = abscissas(b);
        for (std::size_t i = 0; i < b.points.size(); ++i) {
            const auto [distance, way] = known.truth(b.points[i]);
            if (distance < 0.0) continue;
            e.position.push_back(distance / known.radius);
            e.radius.push_back(std::abs(b.radii[i] / known.radius - 1.0));
            const Vec3 t = tangent_at(b, s[i]);
            e.direction.push_back(std::atan2(t.cross(way).norm(), std::abs(t.dot(way))) * 180.0 /
                                  std::numbers::pi);
        }
    }
    return e;
}

std::size_t tip_count(const CenterlineGraph& graph) {
    return tips_by_radius(graph).size();
}

/// Independent loops of the graph.
int loop_count(const CenterlineGraph& graph, int components = 1) {
    return static_cast<int>(graph.branches.size()) - static_cast<int>(graph.nodes.size()) +
           components;
}

void check_accuracy(const Known& known, double cell) {
    const Surface clean = iso_surface(known.shape, known.box, cell);
    const Errors e = errors_of(compute_centerlines(clean), known);
    CHECK(Spread(e.position).mean < 0.005);
    CHECK(Spread(e.position).high < 0.015);
    CHECK(Spread(e.radius).mean < 0.005);
    CHECK(Spread(e.radius).high < 0.015);
    CHECK(Spread(e.direction).high < 1.0);
    const Errors n = errors_of(compute_centerlines(with_noise(clean, 0.1)), known);
    CHECK(Spread(n.position).mean < 0.02);
    CHECK(Spread(n.position).high < 0.05);
    CHECK(Spread(n.radius).mean < 0.02);
    CHECK(Spread(n.radius).high < 0.05);
    CHECK(Spread(n.direction).high < 2.0);
}

CenterlineGraph lines_of_file(const std::string& path) {
    const auto file = read_surface(path);
    return compute_centerlines(file.surface);
}

/// Mean over a reference's points of the distance to the graph in radii, and of the relative
/// difference of the radii.
std::pair<double, double> difference(const CenterlineGraph& graph, const CenterlineGraph& reference,
                                     double scale) {
    double distance = 0.0, radius = 0.0;
    double count = 0.0;
    for (const CenterlineBranch& b : reference.branches)
        for (std::size_t i = 0; i < b.points.size(); ++i) {
            const auto nearest = nearest_place(graph, scale * b.points[i]);
            REQUIRE(nearest);
            const double own =
                radius_at(graph.branches[nearest->place.branch], nearest->place.abscissa);
            distance += nearest->distance / (scale * b.radii[i]);
            radius += std::abs(own / (scale * b.radii[i]) - 1.0);
            count += 1.0;
        }
    return {distance / count, radius / count};
}

}  // namespace

SCENARIO("Lines and radii of raw iso-surfaces are exact", "[geometry][centerlines]") {
    // Cells that give about 12,000 triangles.
    GIVEN("a tube") {
        check_accuracy(tube(), 0.394);
    }
    GIVEN("a rotated tube") {
        check_accuracy(rotated(tube()), 0.42);
    }
    GIVEN("a rotated torus") {
        check_accuracy(rotated(torus()), 0.48);
    }
    GIVEN("a Y") {
        check_accuracy(y_shape(), 0.43);
    }
    GIVEN("a rotated Y of about 50,000 triangles") {
        check_accuracy(rotated(y_shape()), 0.215);
    }
}

SCENARIO("The graph has the topology of the lumen", "[geometry][centerlines]") {
    THEN("a tube has two tips") {
        const auto graph = compute_centerlines(iso_surface(tube().shape, tube().box, 0.5));
        CHECK(graph.branches.size() == 1);
        CHECK(tip_count(graph) == 2);
    }
    THEN("a torus is one loop without a tip") {
        const auto graph = compute_centerlines(iso_surface(torus().shape, torus().box, 0.5));
        CHECK(tip_count(graph) == 0);
        CHECK(loop_count(graph) == 1);
        CHECK(branch_length(graph.branches[0]) == Approx(20.0 * std::numbers::pi).epsilon(0.005));
    }
    THEN("a ring with two stems has one loop and two tips") {
        const ImplicitShape ring = [](const Vec3& p) {
            const double torus = std::hypot(std::hypot(p.x(), p.y()) - 10.0, p.z()) - 1.5;
            const double left = capsule(p, {-10, 0, 0}, {-20, 0, 5}, 1.5);
            const double right = capsule(p, {10, 0, 0}, {20, 3, 0}, 2.0);
            return std::min({torus, left, right});
        };
        const auto graph = compute_centerlines(
            iso_surface(ring, {Vec3(-23.1, -13.2, -4.1), Vec3(23.2, 13.3, 8.1)}, 0.35));
        CHECK(tip_count(graph) == 2);
        CHECK(loop_count(graph) == 1);
        CHECK(graph.branches.size() == 4);
    }
    THEN("two vessels that nearly touch stay apart") {
        const ImplicitShape pair = [](const Vec3& p) {
            const double bow = capsule(p, {0, 0, 0}, {0, 30, 0}, 2.0);
            const double leg = capsule(p, {4.15, 0, 0}, {4.15, 30, 0}, 2.0);
            const double bridge = capsule(p, {0, 0, 0}, {4.15, 0, 0}, 2.0);
            return std::min({bow, leg, bridge});
        };
        const auto graph = compute_centerlines(
            iso_surface(pair, {Vec3(-3.1, -3.1, -3.1), Vec3(7.3, 33.1, 3.1)}, 0.13));
        CHECK(tip_count(graph) == 2);
        CHECK(loop_count(graph) == 0);
    }
    THEN("bumps and a round sac are no branches, a stub is") {
        const auto with = [](const ImplicitShape& extra) {
            const ImplicitShape all = [=](const Vec3& p) {
                return std::min(capsule(p, {0, 0, 0}, {0, 0, 30}, 2.0), extra(p));
            };
            return compute_centerlines(
                iso_surface(all, {Vec3(-3.1, -3.2, -3.1), Vec3(13.2, 3.3, 33.1)}, 0.35));
        };
        CHECK(tip_count(with([](const Vec3& p) { return (p - Vec3(2.0, 0, 12)).norm() - 1.2; })) ==
              2);
        CHECK(tip_count(with([](const Vec3& p) { return (p - Vec3(4.0, 0, 12)).norm() - 3.0; })) ==
              2);
        CHECK(tip_count(with([](const Vec3& p) {
                  return capsule(p, {0, 0, 15}, {8, 0, 15}, 1.0);
              })) == 3);
    }
}

SCENARIO("Openings are tips at their centres", "[geometry][centerlines]") {
    const Vec3 far(0, 0, 20);
    for (const Surface& surface : {open_tube(2.0, 20.0, 32, 64), closed_tube(2.0, 20.0, 32, 64)}) {
        const auto graph = compute_centerlines(surface);
        REQUIRE(graph.branches.size() == 1);
        REQUIRE(tip_count(graph) == 2);
        const std::size_t at = *nearest_tip(graph, far);
        CHECK((graph.nodes[at].position - far).norm() < 1e-6);
        CHECK(graph.nodes[at].radius == Approx(2.0).epsilon(0.01));
        CHECK((outward_direction(graph, at, 0.0) - Vec3::UnitZ()).norm() < 0.01);
        const auto& points = graph.branches[0].points;
        for (std::size_t i = 1; i < points.size(); ++i)
            CHECK((points[i] - points[i - 1]).norm() < 0.25 * 2.0);
    }
}

SCENARIO("Flat closures without labels are ends", "[geometry][centerlines]") {
    const Surface labelled = closed_tube(2.0, 20.0, 32, 64);
    const Surface plain =
        mapped(make_surface(labelled.points(), std::vector<Triangle>(labelled.triangles().begin(),
                                                                     labelled.triangles().end())),
               [](const Vec3& p) { return Vec3(skew_rotation() * p); });
    const auto graph = compute_centerlines(plain);
    REQUIRE(tip_count(graph) == 2);
    const Vec3 far = skew_rotation() * Vec3(0, 0, 20);
    const std::size_t at = *nearest_tip(graph, far);
    CHECK((graph.nodes[at].position - far).norm() < 1e-6);
    CHECK(graph.nodes[at].radius == Approx(2.0).epsilon(0.01));
}

SCENARIO("Orientation and side do not matter, results repeat", "[geometry][centerlines]") {
    const Surface surface = iso_surface(y_shape().shape, y_shape().box, 0.6);
    const auto graph = compute_centerlines(surface);
    std::vector<Triangle> turned(surface.triangles().begin(), surface.triangles().end());
    for (Triangle& t : turned) std::swap(t[0], t[1]);
    const auto inside_out = compute_centerlines(make_surface(surface.points(), turned));
    CHECK(tip_count(inside_out) == 3);
    CHECK(difference(inside_out, graph, 1.0).first < 0.01);
    const auto again = compute_centerlines(surface);
    REQUIRE(again.branches.size() == graph.branches.size());
    for (std::size_t b = 0; b < graph.branches.size(); ++b)
        CHECK(again.branches[b].points == graph.branches[b].points);
}

SCENARIO("Simple points of thinning", "[geometry][centerlines]") {
    const auto bit = [](int cell) { return std::uint32_t{1} << cell; };
    CHECK(is_simple(bit(12)));                             // the end of a line
    CHECK_FALSE(is_simple(bit(12) | bit(14)));             // the middle of a line
    CHECK_FALSE(is_simple(0));                             // alone
    CHECK_FALSE(is_simple((std::uint32_t{1} << 27) - 1));  // inside
}

SCENARIO("A surface without a centerline is rejected with a reason", "[geometry][centerlines]") {
    CHECK_THROWS_AS(compute_centerlines(Surface{}), InvalidInput);
    Surface broken = open_tube(2.0, 20.0, 16, 16);
    Positions points = broken.points();
    points[5].x() = std::nan("");
    CHECK_THROWS_AS(compute_centerlines(broken.with_positions(points)), InvalidInput);
    CHECK_THROWS_AS(compute_centerlines(open_tube(2, 20, 16, 16), {.spacing = 3.0}), InvalidInput);
    CHECK_THROWS_AS(compute_centerlines(open_tube(2, 20, 16, 16), {.ends = {{500, 0, 0}}}),
                    InvalidInput);
}

SCENARIO("Lines of damaged surfaces cost no more than those of whole ones",
         "[geometry][centerlines]") {
    const Surface tube = closed_tube(2.0, 20.0, 12, 12);
    Positions points = tube.points();
    GIVEN("a vertex beyond anything on earth") {
        points[5].x() = 4e33;
        CHECK_THROWS_WITH(compute_centerlines(tube.with_positions(points)),
                          Catch::Contains("vertex 5") && Catch::Contains("10 km"));
    }
    GIVEN(
        "a vertex so far away that a grid of the box's volume has a border of billions of voxels") {
        points[5].x() = 9e6;
        CHECK_THROWS_AS(compute_centerlines(tube.with_positions(points)), AlgorithmFailure);
    }
    GIVEN("vertices that are swapped with others in their neighbourhood") {
        std::mt19937 random(3);
        constexpr std::ptrdiff_t kNear = 24;
        for (auto from = points.begin(); points.end() - from > kNear; from += kNear)
            std::shuffle(from, from + kNear, random);
        CHECK_THROWS_WITH(compute_centerlines(tube.with_positions(points)),
                          Catch::Contains("damaged"));
    }
}

SCENARIO("Every surface of the collection shows its ends", "[geometry][centerlines][slow]") {
    const std::vector<std::pair<const char*, std::size_t>> files = {
        {"gmsh_aorta2_open.stl", 5},
        {"jk_carotid_left_lumen_capped.stl", 3},
        {"jk_carotid_left_lumen_clipped.stl", 3},
        {"jk_carotid_left_lumen_raw.stl", 3},
        {"sv_demo_aortofemoral.vtp", 3},
        {"sv_rom_model_surface.vtp", 3},
        {"v4a_ideal_bifurcation_aneurysm.stl", 3},
        {"v4a_ideal_bifurcation_healthy.stl", 3},
        {"vampy_aneurisk_C0015_artery.vtp", 3},
        {"vampy_artery_bifurcation.stl", 3},
        {"vampy_left_atrium.vtp", 5},
        {"vampy_vein.stl", 2},
        {"vasp_small_aneurysm_fluidboundary.vtp", 3},
        {"vmtk_aorta_surface.stl", 3},
        {"vmtk_aorta_surface_open_ends.stl", 3},
    };
    for (const auto& [name, ends] : files) {
        const std::string path = shared_data(std::string("surfaces/") + name);
        if (path.empty()) return;
        INFO(name);
        const auto graph = lines_of_file(path);
        CHECK(tip_count(graph) == ends);
        CHECK(loop_count(graph) == 0);
    }
}

SCENARIO("Lines agree with VMTK's", "[geometry][centerlines]") {
    struct Pair {
        const char* surface;
        const char* line;
        double scale;
    };

    for (const Pair& pair :
         {Pair{"vmtk_aorta_surface.stl", "vmtk_aorta_centerline.vtp", 1.0},
          Pair{"vmtk_aorta_surface_open_ends.stl", "vmtk_aorta_centerline_open_ends.vtp", 1.0},
          Pair{"sv_demo_aortofemoral.vtp", "sv_demo_centerlines.vtp", 10.0},
          Pair{"jk_carotid_left_lumen_clipped.stl", "jk_carotid_left_centerline.vtp", 1.0}}) {
        const std::string path = shared_data(std::string("surfaces/") + pair.surface);
        if (path.empty()) return;
        INFO(pair.surface);
        const auto reference =
            read_centerlines(shared_data(std::string("centerlines/") + pair.line));
        const auto [distance, radius] = difference(lines_of_file(path), reference, pair.scale);
        CHECK(distance < 0.1);
        CHECK(radius < 0.05);
    }
}

SCENARIO("A tube's mask surface has one line, whatever its terraces", "[geometry][centerlines]") {
    // 27 tubes with round ends: an arc, nearly along the slices' axis, and a helix.
    const auto course = GENERATE(as<std::string>(), "arc", "straight", "helix");
    const Vec3 spacing = GENERATE(Vec3(0.4, 0.4, 0.8), Vec3(0.5, 0.5, 0.5), Vec3(0.3, 0.3, 1.2));
    const double radius = GENERATE(1.2, 2.0, 3.0);
    CAPTURE(course, spacing.transpose(), radius);
    VesselShape tube;
    const int steps = course == "helix" ? 16 : 8;
    for (int i = 0; i <= steps; ++i) {
        const double a = (course == "helix" ? 5.5 : 2.4) * i / steps;
        tube.points.emplace_back(course == "arc" ? Vec3(10 * std::cos(a), 10 * std::sin(a), 4 * a)
                                 : course == "straight"
                                     ? Vec3(0.3 * i, 0.15 * i, 3.0 * i)
                                     : Vec3(9 * std::cos(a), 9 * std::sin(a), 3.5 * a));
        tube.radii.push_back(radius);
    }
    PhantomDescription description;
    description.parts = {{"tube", tube, 0.0}};
    description.imaging.spacing = spacing;
    const Image mask = phantom_mask(description, PhantomField(description.parts));
    const Surface surface =
        extract_surface(mask, {}, {.method = ExtractionMethod::Labels}).surface;  // midway
    const CenterlineGraph graph = compute_centerlines(surface);
    CHECK(graph.branches.size() == 1);
    CHECK(tip_count(graph) == 2);
}

SCENARIO("Radii are those of inscribed circles, a little below the wall's mean radius",
         "[geometry][centerlines]") {
    // An oblique tube in slices of two voxels, as its mask shows it (docs/dev/decisions.md).
    const double radius = GENERATE(1.2, 2.0, 3.0);
    const Vec3 along = Vec3(0.35, 0.2, 0.9).normalized();
    PhantomDescription tube;
    tube.parts = {{"tube", VesselShape{{-15 * along, 15 * along}, {radius, radius}}, 0.0}};
    tube.imaging.spacing = Vec3(0.4, 0.4, 0.8);
    const Image mask = phantom_mask(tube, PhantomField(tube.parts));
    const auto [surface_kind, least] =
        GENERATE(std::pair(MaskSurface::Smooth, 0.965), std::pair(MaskSurface::Midway, 0.92));
    const Surface surface =
        extract_surface(mask, {},
                        {.method = ExtractionMethod::Labels, .mask_surface = surface_kind})
            .surface;
    const CenterlineGraph graph = compute_centerlines(surface);
    CAPTURE(radius, least);
    REQUIRE(graph.branches.size() == 1);
    std::vector<double> radii, walls;
    const CenterlineBranch& line = graph.branches.front();
    for (std::size_t i = 0; i < line.points.size(); ++i)
        if (std::abs(line.points[i].dot(along)) < 8.0) radii.push_back(line.radii[i]);
    for (const Vec3& p : surface.points())
        if (std::abs(p.dot(along)) < 8.0) walls.push_back((p - p.dot(along) * along).norm());
    CAPTURE(radius, mean(radii), mean(walls));
    CHECK(mean(radii) < mean(walls));
    CHECK(mean(radii) > least * mean(walls));
}

SCENARIO("Centerlines are cancelled while the lumen is thinned and the lines are centred",
         "[geometry][centerlines][cancel]") {
    const Surface tube = closed_tube(2.0, 20.0, 24, 40);
    for (const double fraction : {0.0, 0.1, 0.16, 0.7}) {
        StopAt stop(fraction);
        CAPTURE(fraction);
        CHECK_THROWS_AS(compute_centerlines(tube, {}, stop.progress()), Cancelled);
    }
}
