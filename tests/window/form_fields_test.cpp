// The fields of a form as they are drawn: what they show while they are empty, and which are seen.

#include <catch2/catch.hpp>

#include "tests/support/paths.h"
#include "tests/window/window_support.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

SCENARIO("A field shows the value that is automatic", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    REQUIRE(shell->click_item("rail.remeshing"));
    REQUIRE(shell->click_item("choose.remesh"));
    REQUIRE(shell->settle(60s));
    const OperationForm& form = *shell->app().place().form();
    REQUIRE(form.field("edge").automatic);
    const double edge = std::get<double>(*form.field("edge").automatic);
    CHECK(edge == Approx(0.28 * 4.0).epsilon(0.05));
    CHECK(std::get<double>(*form.field("max_edge").automatic) == Approx(2.0 * edge));
    WHEN("it is given, another one follows") {
        shell->app().place().set_field("edge", "1.5");
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(form.field("edge").automatic);
        CHECK(std::get<double>(*form.field("max_edge").automatic) == Approx(3.0));
    }
    WHEN("a field does not apply") {
        shell->app().place().set_field("mode", "uniform");
        REQUIRE(shell->settle(60s));
        THEN("it is hidden, and can be set all the same") {
            CHECK_FALSE(shell->has("field.max_edge"));
            shell->app().place().set_field("max_edge", "2");
            shell->app().place().set_field("mode", "");
            REQUIRE(shell->settle(60s));
            CHECK(shell->has("field.max_edge"));
            CHECK(form.arguments().real("max_edge") == 2.0);
        }
    }
}

SCENARIO("Fields that are seldom needed are folded away", "[window][form]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file());
    REQUIRE(shell->click_item("rail.remeshing"));
    REQUIRE(shell->click_item("choose.remesh"));
    REQUIRE(shell->settle(60s));
    CHECK(shell->has("field.edge"));
    CHECK_FALSE(shell->has("field.gradation"));
    WHEN("they are unfolded") {
        REQUIRE(shell->click_item("field.more"));
        CHECK(shell->has("field.gradation"));
        CHECK_FALSE(shell->has("field.feature_size"));  // needs an angle
        REQUIRE(shell->click_item("field.more"));
        CHECK_FALSE(shell->has("field.gradation"));
    }
    WHEN("one is given") {
        shell->app().place().set_field("gradation", "1.3");
        shell->frame();
        CHECK(shell->has("field.gradation"));
        CHECK_FALSE(shell->has("field.feature_angle"));
        CHECK(shell->app().place().form()->arguments().real("gradation") == 1.3);
    }
}
