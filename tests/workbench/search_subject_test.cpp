#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/phantoms/imaging.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/operation.h"
#include "workbench/operations/smooth/search.h"
#include "workbench/operations/table.h"
#include "workbench/suggest/smoothing_search.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 4.5;  // of the ball [mm]

/// The mask of a ball in voxels of 0.5 mm and slices of so many voxels.
Scene ball_mask(double slices, std::uint64_t seed) {
    PhantomDescription ball = random_sphere(seed, Vec3(0.5, 0.5, 0.5 * slices));
    ball.parts.front() = {"sphere", SphereShape{Vec3::Zero(), kRadius}, 0.0};
    const Image mask = phantom_mask(ball, PhantomField(ball.parts));
    Extraction found = extract_surface(mask, {}, {.method = ExtractionMethod::Labels});
    Scene scene;
    scene.surface = std::move(found.surface);
    scene.sampling = found.sampling;
    return scene;
}

double distance_from_ball(const Surface& surface) {
    double sum = 0.0;
    for (const Vec3& p : surface.points()) sum += std::abs(p.norm() - kRadius);
    return sum / static_cast<double>(surface.vertex_count());
}

bool has_parameter(const SearchSpace& space, const std::string& name) {
    return std::ranges::any_of(space.parameters,
                               [&](const SearchParameter& p) { return p.name == name; });
}

}  // namespace

SCENARIO("A suggestion for a mask keeps the context, and comes nearer to the truth than the recipe",
         "[workbench][suggest]") {
    const double slices = GENERATE(1.0, 2.0, 3.0, 4.0);
    const Scene scene = ball_mask(slices, 7);
    const Operation& smooth = find_operation("smooth");
    const GivenArguments given = arguments_from_texts(
        smooth, std::vector<std::string>{"preset=cfd", "staircase=true", "find_caps=false"});
    Arguments arguments = checked_arguments(given);
    const SmoothingSubject subject = smoothing_subject(scene, given, arguments);
    const ChosenEngine chosen = smoothing_engine(subject, false);
    const SearchSpace space = smoothing_space_for(subject, *chosen.engine, false);
    for (const char* name : {"tau_theta", "tau_max", "beta_min", "alpha"}) {
        CHECK_FALSE(has_parameter(space, name));
        CHECK(has_parameter(smoothing_space_for(subject, *chosen.engine, true), name));
    }
    ParameterSearch search(chosen.engine, space, {});
    const Suggestion found = search.exhaustive(true);
    const double suggested = distance_from_ball(
                     smoothed_with(subject, *scene.surface, space, found.values, {})),
                 recipe = distance_from_ball(*run("smooth", scene, given).scene.surface),
                 raw = distance_from_ball(*scene.surface);
    CAPTURE(slices, raw);
    CHECK(suggested < recipe);
    CHECK(suggested < 0.65 * raw);
}

SCENARIO("A search weighs staircases as smooth does", "[workbench][suggest]") {
    static const Surface vessel = of_mask(vessel_in_slices());
    Surface painted = vessel;
    std::vector<double> paint(vessel.vertex_count());
    for (std::size_t v = 0; v < paint.size(); ++v) paint[v] = v % 2 == 0 ? 0.5 : 1.0;
    painted.attributes["paint"] = std::make_shared<const std::vector<double>>(paint);
    Scene scene;
    scene.surface = painted;
    scene.neighbours["bone"] = icosphere(3.0, 2, Vec3(20, 0, 0));

    const std::string caps = GENERATE("caps=keep", "caps=round", "caps=smooth");
    const std::string scaling = GENERATE("weight=tau-max", "weight=thesis");
    const std::string others =
        GENERATE("painted=paint", "distance=none", "distance=linear", "combine=average");
    const auto subject_with = [&](const std::vector<std::string>& thresholds) {
        std::vector<std::string> texts = {"filter=laplace",
                                          "staircase=true",
                                          "stack_axis=0,0,1",
                                          "beta_min=0.2",
                                          caps,
                                          scaling,
                                          others};
        if (others == "combine=average") {
            texts.push_back("distance=linear");
            texts.push_back("painted=paint");
        }
        texts.insert(texts.end(), thresholds.begin(), thresholds.end());
        const Operation& smooth = find_operation("smooth");
        const GivenArguments given = arguments_from_texts(smooth, texts);
        Arguments arguments = checked_arguments(given);
        return smoothing_subject(scene, given, arguments);
    };
    INFO(caps << ", " << scaling << ", " << others);
    const SmoothingSubject searched = subject_with({});
    const SmoothingSubject other = subject_with({"tau_theta=0.4", "tau_max=1.5"});
    REQUIRE(searched.weights);
    const StaircaseValues& decided = searched.thresholds;
    CHECK(*searched.staircase(decided.tau_theta, decided.tau_max, 0.2) == *searched.weights);
    CHECK(*searched.staircase(0.4, 1.5, 0.2) == *other.weights);
    CHECK(*searched.weights != *other.weights);
}
