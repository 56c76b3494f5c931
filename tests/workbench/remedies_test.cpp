#include <algorithm>
#include <cmath>
#include <regex>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

// A refusal that names a command is followed here, on the model that was refused.

namespace {

/// What the operation says of the model that it refuses.
std::string refusal_of(const std::string& operation, const Surface& surface,
                       const Arguments& arguments = {}) {
    try {
        static_cast<void>(run(operation, surface, arguments));
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

Surface after(const std::string& operation, const Surface& surface,
              const Arguments& arguments = {}) {
    return *run(operation, surface, arguments).scene.surface;
}

/// The number behind a word of the text.
double number_behind(const std::string& word, const std::string& text) {
    CAPTURE(text);
    std::smatch found;
    REQUIRE(std::regex_search(text, found, std::regex(word + "([0-9.eE+-]+)")));
    return std::stod(found[1]);
}

}  // namespace

SCENARIO("remesh: the edge that it recommends can be made", "[workbench][remedies]") {
    const Surface tube = closed_tube(2.0, 30.0, 40, 90);
    const Arguments fine = {{"mode", std::string("uniform")}, {"edge", 0.001}};
    const std::string too_many = refusal_of("remesh", tube, fine);
    CHECK(number_behind("edge=", too_many) > 0.002);
    const Arguments coarse = {{"mode", std::string("uniform")}, {"edge", 8.0}};
    const double edge = number_behind("edge=", refusal_of("remesh", tube, coarse));
    const Surface made = after("remesh", tube, {{"mode", std::string("uniform")}, {"edge", edge}});
    CHECK(volume(made) == Approx(volume(tube)).epsilon(0.05));
}

SCENARIO("remesh and subdivide: repair makes the surface usable", "[workbench][remedies]") {
    // Two bodies that run through each other.
    const Surface crossing = merged(icosphere(3.0, 3), icosphere(3.0, 3, Vec3(2.0, 0.4, 0.3)));
    REQUIRE_THAT(refusal_of("remesh", crossing), Contains("use repair first"));
    CHECK(is_closed_manifold(after("remesh", after("repair", crossing))));
    Surface doubled = merged(open_tube(2.0, 12.0, 24, 20), open_tube(2.0, 12.0, 24, 20));
    const Surface fixed = after("repair", doubled);
    CHECK(after("subdivide", fixed).triangle_count() > fixed.triangle_count());
}

SCENARIO("extrude-opening and tetrahedralize: clip-opening makes the openings",
         "[workbench][remedies]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THAT(refusal_of("extrude-opening", tube), Contains("make them first (clip-opening)"));
    CHECK_THAT(refusal_of("tetrahedralize", tube), Contains("clip-opening makes caps"));
    const Surface clipped = after("clip-opening", tube);
    CHECK(volume(after("extrude-opening", clipped)) > 1.1 * volume(clipped));
    CHECK(run("tetrahedralize", clipped, {}).scene.volume_mesh);
    CHECK(run("tetrahedralize", after("fill-hole", tube), {}).scene.volume_mesh);
}

namespace {

/// The point behind a word of the text: "tip=1,2,3".
Vec3 point_behind(const std::string& word, const std::string& text) {
    CAPTURE(text);
    std::smatch found;
    const std::string number = "(-?[0-9.e+-]+)";
    REQUIRE(
        std::regex_search(text, found, std::regex(word + number + "," + number + "," + number)));
    return {std::stod(found[1]), std::stod(found[2]), std::stod(found[3])};
}

}  // namespace

SCENARIO("extrude-opening: clip-opening makes a dented cap flat", "[workbench][remedies]") {
    const Surface dented = mapped(closed_tube(2.0, 30.0, 40, 90), [](const Vec3& p) {
        const bool middle = p.z() > 29.9 && std::hypot(p.x(), p.y()) < 1.0;
        return Vec3(p.x(), p.y(), middle ? p.z() - 1.0 : p.z());
    });
    const Vec3 tip = point_behind("clip-opening tip=", refusal_of("extrude-opening", dented));
    const Surface flat = after("clip-opening", dented, {{"tip", tip}});
    CHECK(flat.patches == dented.patches);
    CHECK(volume(after("extrude-opening", flat)) > 1.1 * volume(flat));
}

SCENARIO("remove-branch: clip-opening opens the trunk instead", "[workbench][remedies]") {
    const auto fork = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(0, 0, -18), Vec3::Zero(), 2.5),
                         capsule(p, Vec3::Zero(), Vec3(8, 0, 16), 1.8),
                         capsule(p, Vec3::Zero(), Vec3(-8, 0, 16), 1.8)});
    };
    const Surface surface =
        after("repair", iso_surface(fork, {Vec3(-12, -5, -22), Vec3(12, 5, 20)}, 0.5));
    const std::string text = refusal_of("remove-branch", surface, {{"tip", Vec3(0, 0, -20)}});
    CHECK_THAT(text, Contains("is the trunk"));
    const Surface opened =
        after("clip-opening", surface, {{"tip", point_behind("clip-opening tip=", text)}});
    REQUIRE(opened.patches.size() == 2);
    CHECK(patch_shape(opened, 1).plane.point.z() < -15.0);
}

SCENARIO("clip-opening: an inlet far from every opening is opened first", "[workbench][remedies]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    const Arguments far = {{"tip", Vec3(0, 0, 30)}, {"inlet", std::vector{0.0, 0.0, 0.0}}};
    const Vec3 tip = point_behind("clip-opening tip=", refusal_of("clip-opening", tube, far));
    const Surface made = after("clip-opening", after("clip-opening", tube, {{"tip", tip}}), far);
    REQUIRE(made.patches.size() == 3);
    CHECK(made.patches[1].kind == PatchKind::Inlet);
    CHECK(patch_shape(made, 1).plane.point.z() < 1.0);
}

SCENARIO("clip-opening: the further inlets that it proposes become inlets",
         "[workbench][remedies]") {
    // Two vessels side by side that meet behind.
    const auto pair = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(-5, 0, -18), Vec3(0, 0, 0), 2.2),
                         capsule(p, Vec3(5, 0, -18), Vec3(0, 0, 0), 2.0),
                         capsule(p, Vec3::Zero(), Vec3(0, 0, 18), 2.0)});
    };
    const Surface surface =
        after("repair", iso_surface(pair, {Vec3(-9, -5, -22), Vec3(9, 5, 22)}, 0.5));
    const Outcome first = run("clip-opening", surface, {});
    std::string proposed;
    for (const Diagnostic& warning : first.warnings)
        if (warning.code == "further-inlet")
            proposed = warning.remedies.at(0).arguments.at("inlet");
    REQUIRE_FALSE(proposed.empty());
    const auto given = arguments_from_texts(find_operation("clip-opening"),
                                            std::vector<std::string>{"inlet=" + proposed});
    const Surface made = after("clip-opening", surface, *given.operator->());
    CHECK(made.patches[1] == Patch{"inlet_1", PatchKind::Inlet});
    CHECK(made.patches[2] == Patch{"inlet_2", PatchKind::Inlet});
    CHECK(made.patches[3].kind == PatchKind::Outlet);
}

SCENARIO("tetrahedralize: keep-component and repair make one sound part", "[workbench][remedies]") {
    const Surface two = merged(icosphere(3.0, 3), icosphere(2.0, 3, Vec3(20, 0, 0)));
    CHECK_THAT(refusal_of("tetrahedralize", two), Contains("use keep-component"));
    CHECK(run("tetrahedralize", after("keep-component", two), {}).scene.volume_mesh);
    const Surface turned = flipped(icosphere(3.0, 3));
    CHECK_THAT(refusal_of("tetrahedralize", turned), Contains("use repair"));
    CHECK(run("tetrahedralize", after("repair", turned), {}).scene.volume_mesh);
}
