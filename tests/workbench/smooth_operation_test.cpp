#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/unsmoothed.h"
#include "geometry/phantoms/phantom.h"
#include "smoothing/context/distance_weights.h"
#include "tests/support/iso_surface.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "tests/support/surface_facts.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/checked_value.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/session/replay_tolerance.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

Outcome smooth(const Scene& scene, const Arguments& arguments) {
    return run("smooth", scene, arguments);
}

Scene scene_of(const Surface& surface) {
    Scene scene;
    scene.surface = surface;
    return scene;
}

/// A vessel in slices of 2 mm along z, and one that leans on them.
Scene terraced_vessel() {
    const auto shape = [](const Vec3& p) {
        const double z = 2.0 * std::round(p.z() / 2.0);
        return capsule(Vec3(p.x(), p.y(), z), Vec3(-8, 0, -6), Vec3(8, 0, 6), 4.0);
    };
    return scene_of(iso_surface(shape, {Vec3(-14, -6, -12), Vec3(14, 6, 12)}, 0.43));
}

Positions moved_points(const Scene& scene, const Arguments& arguments) {
    return smooth(scene, arguments).scene.surface->points();
}

}  // namespace

SCENARIO("smooth takes the stack axis from the image, or from the user", "[workbench][smooth]") {
    Scene scene = terraced_vessel();
    const Arguments by_hand{{"staircase", true},
                            {"stack_axis", Vec3(0, 0, 2)},
                            {"tau_theta", 0.6},
                            {"tau_max", 2.0},
                            {"filter", "laplace"}};
    const Outcome by_user = smooth(scene, by_hand);
    CHECK(by_user.report->at("stack_axis_from") == "argument");
    CHECK(by_user.report->at("staircase_vertices") > 100);
    scene.sampling = Sampling{.spacing = Vec3(0.4, 0.4, 2.0), .confidence = 1.0};
    const Outcome by_image =
        smooth(scene, {{"staircase", true}, {"tau_theta", 0.6}, {"filter", "laplace"}});
    CHECK(by_image.report->at("stack_axis_from") == "image");
    CHECK(by_image.resolved.point("stack_axis") == Vec3(0, 0, 1));
    CHECK(by_image.scene.surface->points() == by_user.scene.surface->points());
    GIVEN("staircases are smoothed, the rest stays") {
        const auto moved = moved_vertices(*scene.surface, *by_user.scene.surface);
        CHECK(moved > 100);
        CHECK(by_user.report->at("normal_curvature_after_deg") <
              by_user.report->at("normal_curvature_before_deg"));
        const Outcome more = smooth(scene, {{"staircase", true}, {"tau_max", 0.5}});
        CHECK(moved_vertices(*scene.surface, *more.scene.surface) < moved);
    }
}

SCENARIO("smooth estimates the stack axis of a surface that lost its image",
         "[workbench][smooth]") {
    const Vec3 axis = skew_rotation() * Vec3(0, 0, 1);
    const Image mask = make_phantom(builtin_phantom("tumour")).mask;  // slices of 3 mm
    const Surface drawn =
        extract_surface(mask, std::nullopt, {.method = ExtractionMethod::Labels}).surface;
    const Scene scene =
        scene_of(mapped(drawn, [](const Vec3& p) { return Vec3(skew_rotation() * p); }));
    const Outcome outcome = smooth(scene, {{"staircase", true}});
    CHECK(outcome.report->at("stack_axis_from") == "estimate");
    CHECK(std::abs(outcome.resolved.point("stack_axis").dot(axis)) > std::cos(M_PI / 180.0));
    GIVEN("a tube whose flat ends are its only flat parts") {
        const Surface tube = fine_tube(3.0, 12.0, 96);
        const Surface plain =
            make_surface(tube.points(), {tube.triangles().begin(), tube.triangles().end()});
        CHECK_THROWS_AS(smooth(scene_of(plain), {{"staircase", true}}), AlgorithmFailure);
    }
}

SCENARIO("smooth reports its distance from the original surface", "[workbench][smooth]") {
    GIVEN("a sphere, whose vertices can only go inward") {
        const Surface sphere = icosphere(5.0, 4);
        const Outcome outcome =
            smooth(scene_of(sphere), {{"filter", "laplace"}, {"iterations", std::int64_t{50}}});
        const Json& error = outcome.report->at("local_error");
        double sunk = 0.0;
        for (const Vec3& p : outcome.scene.surface->points())
            sunk += (5.0 - p.norm()) / static_cast<double>(sphere.vertex_count());
        CHECK(sunk > 0.05);
        CHECK(error["mean_mm"] == Approx(sunk).epsilon(0.02));
        CHECK(error["largest_mm"] >= error["mean_mm"]);
    }
    GIVEN("a tube that keeps its caps: no vertex is farther off than it moved") {
        const Surface tube = fine_tube(3.0, 12.0, 48);
        const Outcome outcome = smooth(scene_of(tube), {});
        CHECK(outcome.report->at("local_error").at("largest_mm") <=
              longest_way(tube, *outcome.scene.surface));
    }
    GIVEN("no iteration") {
        const Json report =
            *smooth(scene_of(icosphere(5.0, 3)), {{"iterations", std::int64_t{0}}}).report;
        CHECK(report["local_error"]["largest_mm"] == 0.0);
    }
}

SCENARIO("smooth reports an uncertain stack axis instead of guessing", "[workbench][smooth]") {
    const Scene sphere = scene_of(icosphere(5.0, 4));
    CHECK_THROWS_AS(smooth(sphere, {{"staircase", true}}), AlgorithmFailure);
    CHECK_THROWS_WITH(smooth(sphere, {{"staircase", true}}), Catch::Contains("give stack_axis"));
}

SCENARIO("smooth keeps the distance to neighbours", "[workbench][smooth]") {
    Scene scene = scene_of(icosphere(5.0, 4));
    const Surface neighbour = icosphere(3.0, 3, Vec3(9.0, 0, 0));
    CHECK_THROWS_WITH(smooth(scene, {{"distance", "linear"}}), Catch::Contains("load-neighbour"));
    scene.neighbours["tumour"] = neighbour;
    const std::vector<Surface> neighbours = {neighbour};
    const auto gap = [&](const Positions& points) {
        const auto distances = neighbour_distances(points, neighbours);
        return *std::min_element(distances.begin(), distances.end());
    };
    const Arguments strong{
        {"filter", "laplace"}, {"lambda", 1.0}, {"iterations", std::int64_t{30}}};
    const double before = gap(scene.surface->points());
    CHECK(gap(moved_points(scene, strong)) > before + 0.2);
    for (const char* distance : {"linear", "margin", "exponential"}) {
        Arguments aware = strong;
        aware.set("distance", std::string(distance));
        const Outcome outcome = smooth(scene, aware);
        const double after = gap(outcome.scene.surface->points());
        CHECK(after == Approx(before).margin(0.02));
        CHECK(outcome.report->at("smallest_neighbour_distance_mm") == before);
        CHECK(outcome.report->at("smallest_neighbour_distance_after_mm") == after);
    }
}

SCENARIO("smooth says why nothing moved", "[workbench][smooth]") {
    Scene scene = scene_of(icosphere(5.0, 3));
    scene.neighbours["tumour"] = icosphere(3.0, 3, Vec3(9.0, 0, 0));
    const auto warning = [&](const Arguments& arguments) {
        const Outcome outcome = smooth(scene, arguments);
        return outcome.warnings.empty() ? Diagnostic{} : outcome.warnings.front();
    };
    const Diagnostic flat = warning({{"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}});
    CHECK(flat.code == "nothing-moved");
    CHECK(flat.figures.at("tau_theta") == 0.5);
    CHECK(warning({{"distance", "margin"}, {"margin", 50.0}}).figures.at("margin_mm") == 50.0);
    CHECK(warning({{"distance", "margin"}, {"margin", 2.0}}).code.empty());
    CHECK(warning({{"iterations", std::int64_t{0}}}).code.empty());  // as asked for
}

SCENARIO("Arguments without effect are reported with what they need", "[workbench][smooth]") {
    const Operation& operation = find_operation("smooth");
    const auto idle = [&](const Arguments& given) {
        const Outcome outcome = smooth(scene_of(icosphere(5.0, 2)), given);
        std::vector<std::string> texts;
        for (const Diagnostic& warning :
             arguments_without_effect(operation, given, outcome.resolved))
            texts.push_back(warning.words.at("argument") + " needs " +
                            warning.words.at("condition"));
        return texts;
    };
    using Warnings = std::vector<std::string>;
    CHECK(idle({{"margin", 2.0}}) == Warnings{"margin needs distance=margin"});
    CHECK(idle({{"preset", "elongated"}, {"beta", 0.4}, {"mu", -0.6}}) ==
          Warnings{"beta needs filter=laplace-hc"});
    CHECK(idle({{"curvature", 0.4}}) ==
          Warnings{"curvature needs filter=anisotropic or curvature-triggered"});
    CHECK(idle({{"tau_theta", 0.3}, {"staircase", false}}).size() == 1);
    CHECK(idle({{"lambda", 0.4}, {"find_caps", false}}).empty());
    for (const Parameter& parameter : operation.parameters)
        if (parameter.only_with)
            for (const std::string& value : parameter.only_with->values)
                CHECK_NOTHROW(checked_value(
                    find_parameter(operation, parameter.only_with->parameter), value));
}

SCENARIO("A neighbour that is loaded later changes no smoothing made before",
         "[workbench][smooth]") {
    Scene scene = scene_of(icosphere(5.0, 3));
    scene.neighbours.emplace("far", icosphere(2.0, 2, Vec3(14, 0, 0)));
    const Outcome first = smooth(scene, {{"distance", "linear"}});
    CHECK(first.resolved.text("neighbours") == "far");
    scene.neighbours.emplace("near", icosphere(2.0, 2, Vec3(0, 8, 0)));
    CHECK(smooth(scene, first.resolved).scene.surface->points() == first.scene.surface->points());
    const Outcome both = smooth(scene, {{"distance", "linear"}});
    CHECK(both.resolved.text("neighbours") == "far,near");
    CHECK(both.scene.surface->points() != first.scene.surface->points());
    CHECK_THROWS_WITH(smooth(scene, {{"distance", "linear"}, {"neighbours", "far,nera"}}),
                      Catch::Contains("'nera'"));
}

SCENARIO("smooth reports what holds it back nearly everywhere", "[workbench][smooth]") {
    Scene scene = scene_of(icosphere(5.0, 3));
    scene.neighbours.emplace("near", icosphere(2.0, 2, Vec3(0, 8, 0)));
    const Outcome held = smooth(scene, {{"distance", "exponential"}, {"omega", 20.0}});
    CHECK(held.report->at("mean_weight_distance") < 0.02);
    REQUIRE(held.warnings.size() == 1);
    CHECK(held.warnings[0].code == "weights-hold-back");
    CHECK(held.warnings[0].figures.at("distance_weight") < 0.02);
    CHECK(smooth(scene, {{"distance", "linear"}}).warnings.empty());
}

SCENARIO("smooth uses painted weights, and weights multiply", "[workbench][smooth]") {
    Scene scene = terraced_vessel();
    Surface& surface = *scene.surface;
    CHECK_THROWS_WITH(smooth(scene, {{"painted", "mine"}}), Catch::Contains("'mine'"));
    std::vector<double> painted(surface.vertex_count());
    for (std::size_t v = 0; v < painted.size(); ++v)
        painted[v] = surface.points()[v].x() > 0.0 ? 1.0 : 0.0;
    surface.attributes["mine"] = std::make_shared<std::vector<double>>(painted);
    const Positions points = moved_points(
        scene, {{"painted", "mine"}, {"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}});
    const Positions all = moved_points(scene, {{"staircase", true}, {"stack_axis", Vec3(0, 0, 1)}});
    int here = 0, there = 0;
    for (std::size_t v = 0; v < painted.size(); ++v) {
        if (surface.points()[v].x() <= 0.0) CHECK(points[v] == surface.points()[v]);
        if (surface.points()[v].x() > 1.0) here += points[v] != surface.points()[v] ? 1 : 0;
        if (surface.points()[v].x() < -1.0) there += all[v] != surface.points()[v] ? 1 : 0;
    }
    CHECK(here > 50);
    CHECK(there > 50);
    painted[3] = 1.5;
    surface.attributes["mine"] = std::make_shared<std::vector<double>>(painted);
    CHECK_THROWS_AS(smooth(scene, {{"painted", "mine"}}), AlgorithmFailure);
}

SCENARIO("smooth keeps what it found as vertex attributes", "[workbench][smooth]") {
    const Scene scene = terraced_vessel();
    Arguments arguments{{"filter", "laplace"}, {"staircase", true}, {"stack_axis", Vec3(0, 0, 1)},
                        {"tau_theta", 0.5},    {"tau_max", 2.0},    {"beta_min", 0.0},
                        {"find_caps", false}};
    CHECK(smooth(scene, arguments).scene.surface->attributes.empty());
    arguments.set("keep_weights", true);
    const Outcome outcome = smooth(scene, arguments);
    const Surface& after = *outcome.scene.surface;
    const auto& kept = after.attributes;
    REQUIRE(kept.size() == 6);  // no neighbour is loaded
    const std::vector<double>& weight = *kept.at("smoothing_weight");
    const std::vector<double>& staircase = *kept.at("staircase");
    std::size_t steps = 0, still = 0;
    for (std::size_t v = 0; v < after.vertex_count(); ++v) {
        if (staircase[v] == 1.0) {
            ++steps;
            CHECK(weight[v] == 1.0);
        }
        if (weight[v] == 0.0) {
            ++still;
            CHECK(after.points()[v] == scene.surface->points()[v]);
            CHECK((*kept.at("local_error"))[v] < 1e-9);
        }
    }
    CHECK(steps == outcome.report->at("staircase_vertices").get<std::size_t>());
    CHECK(still > 0);
    CHECK(*kept.at("staircase_weight") == weight);
    CHECK(mean(weight) == Approx(outcome.report->at("mean_weight").get<double>()));
    CHECK(*kept.at("cap") == std::vector<double>(after.vertex_count(), 0.0));
    CHECK(*kept.at("mean_curvature") == mean_curvature(after).values);
}

SCENARIO("smooth keeps the places before it as vertex attributes", "[workbench][smooth]") {
    const Scene scene = terraced_vessel();
    const Outcome outcome =
        smooth(scene, {{"filter", "laplace"}, {"iterations", 2}, {"keep_unsmoothed", true}});
    CHECK(outcome.scene.surface->points() != scene.surface->points());
    CHECK(unsmoothed(*outcome.scene.surface) == scene.surface->points());
}

SCENARIO("smooth keeps the distances to neighbours as a vertex attribute", "[workbench][smooth]") {
    Scene scene = terraced_vessel();
    const Surface ball = icosphere(3.0, 2);
    Positions points = ball.points();
    for (Vec3& p : points) p += Vec3(0, 12, 0);
    scene.neighbours["ball"] = ball.with_positions(points);
    const Outcome outcome =
        smooth(scene, {{"filter", "laplace"}, {"distance", "linear"}, {"keep_weights", true}});
    const auto& distances = *outcome.scene.surface->attributes.at("neighbour_distance");
    CHECK(std::ranges::min(distances) ==
          outcome.report->at("smallest_neighbour_distance_after_mm").get<double>());
    CHECK_FALSE(outcome.scene.surface->attributes.contains("staircase"));
}

SCENARIO("smooth keeps, smooths or rounds caps", "[workbench][smooth]") {
    const Surface tube = fine_tube(3.0, 12.0, 48);
    const Surface plain =
        make_surface(tube.points(), {tube.triangles().begin(), tube.triangles().end()});
    const auto length_after = [&](const Surface& surface, const char* caps, bool find) {
        const Outcome outcome =
            smooth(scene_of(surface),
                   {{"filter", "laplace"}, {"caps", std::string(caps)}, {"find_caps", find}});
        const Bounds box = bounds(*outcome.scene.surface);
        return box.max.z() - box.min.z();
    };
    CHECK(length_after(tube, "keep", false) == 12.0);  // patches are caps by definition
    CHECK(length_after(plain, "keep", true) == 12.0);  // others are found
    CHECK(length_after(tube, "round", true) > 16.0);
    CHECK(length_after(plain, "round", true) > 16.0);
    CHECK(length_after(tube, "smooth", true) < 12.5);
    const Outcome kept = smooth(scene_of(plain), {{"filter", "laplace"}});
    CHECK(kept.report->at("caps") == 2);
}

SCENARIO("smooth constrains vertices to the image's voxels", "[workbench][smooth]") {
    Scene scene = terraced_vessel();
    CHECK_THROWS_AS(smooth(scene, {{"constraint", "voxel"}}), UsageError);
    CHECK_THROWS_WITH(smooth(scene, {{"constraint", "voxel"}, {"cell", Vec3(1, 0, 1)}}),
                      Catch::Contains("'cell'"));
    scene.sampling = Sampling{.spacing = Vec3(0.4, 0.4, 2.0), .confidence = 1.0};
    const Outcome outcome =
        smooth(scene, {{"constraint", "voxel"}, {"filter", "laplace"}, {"lambda", 1.0}});
    CHECK(outcome.resolved.point("cell") == Vec3(0.4, 0.4, 2.0));
    const Positions& before = scene.surface->points();
    for (std::size_t v = 0; v < before.size(); ++v) {
        const Vec3 moved = (outcome.scene.surface->points()[v] - before[v]).cwiseAbs();
        CHECK((moved.x() <= 0.2 + 1e-9 && moved.y() <= 0.2 + 1e-9 && moved.z() <= 1.0 + 1e-9));
    }
}

SCENARIO("Presets supply what is not given, and a replay decides nothing", "[workbench][smooth]") {
    const Scene scene = terraced_vessel();
    const Outcome elongated = smooth(scene, {{"preset", "elongated"}});
    CHECK(elongated.resolved.text("filter") == "taubin");
    CHECK(elongated.resolved.real("mu") == Approx(-0.51));
    const Outcome own = smooth(scene, {{"preset", "elongated"}, {"filter", "laplace"}});
    CHECK(own.resolved.text("filter") == "laplace");
    for (const char* filter : {"anisotropic", "curvature-triggered", "mean-curvature-flow"}) {
        const Outcome first = smooth(scene, {{"filter", std::string(filter)}});
        const Outcome again = smooth(scene, first.resolved);
        CHECK(again.resolved == first.resolved);
        CHECK(again.scene.surface->points() == first.scene.surface->points());
    }
}

SCENARIO("smooth records the device, and commits the CPU's bits unless the GPU is asked for",
         "[workbench][smooth][device]") {
    const Scene scene = terraced_vessel();
    const Outcome plain = smooth(scene, {{"iterations", std::int64_t{10}}});
    CHECK(plain.resolved.text("device") == "cpu");
    CHECK(plain.warnings.empty());
    const Outcome on_gpu =
        smooth(scene, {{"iterations", std::int64_t{10}}, {"device", std::string("gpu")}});
    const auto distance = replay_distance(*plain.scene.surface, *on_gpu.scene.surface);
    REQUIRE(distance);
    CHECK(distance->allowed);
    CHECK(plain.device == "cpu");
    CHECK(on_gpu.device == on_gpu.resolved.text("device"));
    if (on_gpu.device == "gpu") {
        CHECK(on_gpu.warnings.empty());
        CHECK(distance->largest > 0.0);  // single precision
    } else {
        skip("no OpenGL, the CPU served");
        REQUIRE(on_gpu.warnings.size() == 1);
        CHECK(on_gpu.scene.surface->points() == plain.scene.surface->points());
    }
}

SCENARIO("A GPU finds the same context as the CPU", "[workbench][smooth][device]") {
    const auto shape = [](const Vec3& p) {  // cut off where the image ends
        const double z = 2.0 * std::round(p.z() / 2.0);
        const double vessel = capsule(Vec3(p.x(), p.y(), z), Vec3(-8, 0, -6), Vec3(8, 0, 6), 4.0);
        return std::max(vessel, -4.0 - p.z());
    };
    Scene scene = scene_of(iso_surface(shape, {Vec3(-14, -6, -12), Vec3(14, 6, 12)}, 0.43));
    scene.neighbours["tumour"] = icosphere(3.0, 3, Vec3(9.0, 0, 0));
    const Surface& surface = *scene.surface;
    for (const char* caps : {"keep", "round"}) {
        Arguments arguments{{"staircase", true},
                            {"stack_axis", Vec3(0, 0, 1)},
                            {"distance", "linear"},
                            {"caps", std::string(caps)}};
        arguments.set("device", std::string("cpu"));
        const Outcome cpu = smooth(scene, arguments);
        arguments.set("device", std::string("gpu"));
        const Outcome gpu = smooth(scene, arguments);
        CHECK(cpu.report->at("caps") == 1);
        CHECK(moved_vertices(surface, *cpu.scene.surface) > 100);
        double farthest = 0.0;
        for (std::size_t v = 0; v < surface.vertex_count(); ++v)
            farthest = std::max(
                farthest, (gpu.scene.surface->points()[v] - cpu.scene.surface->points()[v]).norm());
        CHECK(farthest <= 1e-5 * bounds(surface).diagonal());
        if (gpu.resolved.text("device") == "cpu") {
            skip("no OpenGL, the CPU served");
            CHECK(*gpu.report == *cpu.report);
            continue;
        }
        Arguments resolved = gpu.resolved;
        resolved.set("device", std::string("cpu"));
        CHECK(resolved == cpu.resolved);
        CHECK(gpu.warnings == cpu.warnings);
        const Json on_gpu = gpu.report->flatten(), on_cpu = cpu.report->flatten();
        REQUIRE(on_gpu.size() == on_cpu.size());
        for (const auto& [name, value] : on_cpu.items()) {
            INFO(name);
            const Json& found = on_gpu.at(name);
            if (value.is_number_float())
                CHECK(found.get<double>() == Approx(value.get<double>()).epsilon(1e-4));
            else
                CHECK(found == value);
        }
    }
}

SCENARIO("Smoothing on a GPU is replayed by tolerance", "[workbench][smooth][device]") {
    const std::string folder = temporary_folder();
    write_surface(*terraced_vessel().surface, folder + "/vessel.vtp");
    SessionOptions options{.find = find_operation};
    options.worker.command = {test::program_path(), "--worker"};
    Session session = Session::create(folder + "/case.vbench", options);
    session.apply("load-surface", {{"file", folder + "/vessel.vtp"}});
    const LogEntry cpu = session.apply("smooth", {{"iterations", std::int64_t{5}}});
    CHECK(cpu.result->device == "cpu");
    const LogEntry gpu =
        session.apply("smooth", {{"iterations", std::int64_t{5}}, {"device", std::string("gpu")}});
    if (gpu.result->device != "gpu") {
        skip("no OpenGL, the CPU served");
        return;
    }
    CHECK(gpu.result->resolved.text("device") == "gpu");
    for (const ReplayEntry& entry : session.replay()) {
        CHECK(entry.replayed);
        CHECK(entry.differences.empty());
    }
}

SCENARIO("A replay on another device may differ as devices do, and no more",
         "[workbench][smooth][device]") {
    const Surface sphere = icosphere(10.0, 4);
    const auto far = [&](double distance, std::size_t vertices) {
        Positions points = sphere.points();
        for (std::size_t v = 0; v < vertices; ++v) points[v] += Vec3(distance, 0.0, 0.0);
        return *replay_distance(sphere, sphere.with_positions(points));
    };
    CHECK(far(0.0, 0).allowed);
    CHECK(far(1e-4, 2562).allowed);  // the diagonal is 34.6 mm
    CHECK(far(1e-4, 2562).largest == Approx(1e-4));
    CHECK_FALSE(far(5e-4, 2562).allowed);
    CHECK(far(5e-3, 1).allowed);
    CHECK_FALSE(far(5e-3, 10).allowed);
    CHECK_FALSE(far(0.1, 1).allowed);
    CHECK_FALSE(replay_distance(sphere, icosphere(10.0, 3)));
}
