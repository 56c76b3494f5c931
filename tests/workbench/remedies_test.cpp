#include <regex>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"

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
    REQUIRE_THAT(refusal_of("remesh", crossing), Contains("use repair before remesh"));
    CHECK(is_closed_manifold(after("remesh", after("repair", crossing))));
    Surface doubled = merged(open_tube(2.0, 12.0, 24, 20), open_tube(2.0, 12.0, 24, 20));
    const Surface fixed = after("repair", doubled);
    CHECK(after("subdivide", fixed).triangle_count() > fixed.triangle_count());
}

SCENARIO("extrude-opening and tetrahedralize: clip-opening makes the openings",
         "[workbench][remedies]") {
    const Surface tube = open_tube(2.0, 30.0, 40, 90);
    CHECK_THAT(refusal_of("extrude-opening", tube), Contains("make them first (clip-opening)"));
    CHECK_THAT(refusal_of("tetrahedralize", tube), Contains("`clip-opening` makes caps"));
    const Surface clipped = after("clip-opening", tube);
    CHECK(volume(after("extrude-opening", clipped)) > 1.1 * volume(clipped));
    CHECK(run("tetrahedralize", clipped, {}).scene.volume_mesh);
    CHECK(run("tetrahedralize", after("fill-hole", tube), {}).scene.volume_mesh);
}

SCENARIO("tetrahedralize: keep-component and repair make one sound part", "[workbench][remedies]") {
    const Surface two = merged(icosphere(3.0, 3), icosphere(2.0, 3, Vec3(20, 0, 0)));
    CHECK_THAT(refusal_of("tetrahedralize", two), Contains("run `keep-component`"));
    CHECK(run("tetrahedralize", after("keep-component", two), {}).scene.volume_mesh);
    const Surface turned = flipped(icosphere(3.0, 3));
    CHECK_THAT(refusal_of("tetrahedralize", turned), Contains("`repair`"));
    CHECK(run("tetrahedralize", after("repair", turned), {}).scene.volume_mesh);
}
