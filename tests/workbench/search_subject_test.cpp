#include <catch2/catch.hpp>

#include "tests/support/stack_phantoms.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/operation.h"
#include "workbench/operations/smooth/search.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A search weighs staircases as smooth does", "[workbench][suggest]") {
    static const Surface vessel = of_mask(vessel_in_slices());
    Surface painted = vessel;
    std::vector<double> paint(vessel.vertex_count());
    for (std::size_t v = 0; v < paint.size(); ++v) paint[v] = v % 2 == 0 ? 0.5 : 1.0;
    painted.attributes["paint"] = std::make_shared<const std::vector<double>>(paint);
    Scene scene;
    scene.surface = painted;

    const std::string caps = GENERATE("caps=keep", "caps=round", "caps=smooth");
    const std::string scaling = GENERATE("weight=tau-max", "weight=thesis");
    const std::string others = GENERATE("painted=paint", "distance=none");
    const auto subject_with = [&](const std::vector<std::string>& thresholds) {
        std::vector<std::string> texts = {"filter=laplace",
                                          "staircase=true",
                                          "stack_axis=0,0,1",
                                          "beta_min=0.2",
                                          caps,
                                          scaling,
                                          others};
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
    CHECK(*searched.staircase(0.7, 3.0, 0.2) == *searched.weights);
    CHECK(*searched.staircase(0.4, 1.5, 0.2) == *other.weights);
    CHECK(*searched.weights != *other.weights);
}
