#include "workbench/window/features/live/parameter_drive.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "workbench/operations/table.h"

using namespace vesselbench;

namespace {

using Strings = std::vector<std::string>;

const Parameter& parameter(const std::string& name) {
    return find_parameter(find_operation("smooth"), name);
}

}  // namespace

SCENARIO("Numbers that have an effect can be driven", "[window][live]") {
    OperationForm form(find_operation("smooth"));
    CHECK(driven_parameters(form) == Strings{"iterations", "lambda"});
    form.set("filter", "laplace-hc");
    CHECK(driven_parameters(form) == Strings{"iterations", "lambda", "alpha", "beta"});
    form.set("staircase", "true");
    form.set("filter", "taubin");
    CHECK(driven_parameters(form) ==
          Strings{"iterations", "lambda", "mu", "tau_theta", "tau_max", "beta_min"});
    THEN("an axis whose parameter cannot be driven takes another one") {
        CHECK(usable_axes(form, {"iterations", "lambda", "beta_min"}) ==
              DriveAxes{"iterations", "lambda", "beta_min"});
        form.set("staircase", "false");
        CHECK(usable_axes(form, {"iterations", "lambda", "beta_min"}) ==
              DriveAxes{"iterations", "lambda", "mu"});
    }
}

SCENARIO("Movements change values at the pace of their ranges", "[window][live]") {
    GIVEN("a count") {
        CHECK(driven_value(parameter("iterations"), 20, 80) == 30);
        CHECK(driven_value(parameter("iterations"), 20, -3) == 20);
        CHECK(driven_value(parameter("iterations"), 20, -800) == 0);
        CHECK(driven_text(parameter("iterations"), 30) == "30");
    }
    GIVEN("a share") {
        CHECK(driven_value(parameter("lambda"), 0.5, 100) == Approx(0.75));
        CHECK(driven_value(parameter("lambda"), 0.5, 1e4) == 1.0);
        CHECK(driven_value(parameter("lambda"), 0.5, -1e4) == 0.0);
        CHECK(driven_text(parameter("lambda"), 0.1 + 0.2) == "0.3");
    }
    GIVEN("a length") {
        CHECK(driven_value(parameter("tau_max"), 2.0, 0) == 2.0);
        CHECK(driven_value(parameter("tau_max"), 2.0, 150) == Approx(5.44));
        CHECK(driven_value(parameter("tau_max"), 2.0, -150) == Approx(0.736));
        CHECK(driven_value(parameter("tau_max"), 2.0, -1e5) > 0.0);
    }
    GIVEN("a negative one") {
        CHECK(driven_value(parameter("mu"), -0.5, -100) == Approx(-1.0));
        CHECK(driven_value(parameter("mu"), -0.5, 1e4) == 0.0);
    }
}

SCENARIO("A movement gives texts to what it drives", "[window][live]") {
    OperationForm form(find_operation("smooth"));
    form.set("filter", "laplace-hc");
    form.set("lambda", "0.4");
    const DriveAxes axes{"iterations", "lambda", "alpha"};
    THEN("what is not given begins with what was decided") {
        const auto texts = driven_texts(form, {{"iterations", 20}, {"alpha", 0.0}}, axes,
                                        {.across = 40, .up = 40, .shifted = 40});
        CHECK(texts ==
              std::vector<FieldText>{{"iterations", "25"}, {"lambda", "0.5"}, {"alpha", "0.1"}});
    }
    THEN("what nobody knows is not driven") {
        CHECK(driven_texts(form, {}, axes, {.across = 40, .up = 40}) ==
              std::vector<FieldText>{{"lambda", "0.5"}});
    }
    THEN("the way back gives the texts from before") {
        CHECK(driven_texts(form, {{"iterations", 20}}, axes, {.across = 0, .up = 0}) ==
              std::vector<FieldText>{{"iterations", ""}, {"lambda", "0.4"}});
    }
}

SCENARIO("Places on an axis are round values", "[window][live]") {
    CHECK(rounded_on_axis(0.4998, 0.0, 1.0) == Approx(0.5));
    CHECK(rounded_on_axis(0.3141, 0.02, 1.0) == Approx(0.314));
    CHECK(rounded_on_axis(1.23456, 0.56, 2.8) == Approx(1.23));
    CHECK(rounded_on_axis(17.37, 0.0, 50.0) == Approx(17.4));
    THEN("its ends are never left, and are reached") {
        CHECK(rounded_on_axis(0.0201, 0.02, 1.0) == Approx(0.02).margin(1e-3));
        CHECK(rounded_on_axis(5.0, 0.57, 2.83) == 2.83);
        CHECK(rounded_on_axis(0.0, 0.57, 2.83) == 0.57);
        CHECK(rounded_on_axis(3.0, 2.0, 2.0) == 2.0);
    }
}
