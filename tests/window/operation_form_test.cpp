#include "workbench/window/form/operation_form.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/operations/table.h"
#include "workbench/window/form/automatic_values.h"

using namespace vesselbench;
using Catch::Matchers::Contains;

SCENARIO("A form's texts become arguments", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    CHECK(form.valid());
    CHECK(form.arguments() == Arguments{});
    form.set("lambda", "0.25");
    form.set("iterations", "3");
    CHECK(form.arguments() == Arguments{{"lambda", 0.25}, {"iterations", Value(std::int64_t{3})}});
    form.reset();
    CHECK(form.arguments() == Arguments{});
}

SCENARIO("A form may start with arguments", "[window][form]") {
    const Arguments start{{"preset", "cfd"}, {"staircase", true}};
    OperationForm form(find_operation("smooth"), start);
    CHECK_FALSE(form.edit());
    CHECK(form.arguments() == start);
    form.set("staircase", "false");
    form.set("lambda", "0.2");
    form.reset();
    CHECK(form.arguments() == start);
}

SCENARIO("Smoothing starts as the recipe smooths where the voxels are known", "[window][form]") {
    const Operation& smooth = find_operation("smooth");
    Scene scene;
    CHECK(smooth.suggested(scene, "cfd") == Arguments{});
    scene.sampling = Sampling{.spacing = Vec3(0.3, 0.3, 0.6), .confidence = 1.0};
    CHECK(smooth.suggested(scene, "cfd") == Arguments{{"preset", "cfd"}, {"staircase", true}});
    CHECK(smooth.suggested(scene, "simulation") ==
          Arguments{{"preset", "simulation"}, {"staircase", false}});
    CHECK(smooth.suggested(scene, "my-own-variant") == Arguments{});
}

SCENARIO("A number may be typed with a decimal comma", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    form.set("lambda", "0,25");
    CHECK(form.field("lambda").text == "0.25");
    CHECK(form.valid());
    OperationForm clip(find_operation("clip-opening"));
    clip.set("inlet", "1,2,3");  // a point keeps its commas
    CHECK(clip.field("inlet").text == "1,2,3");
}

SCENARIO("A wrong text has the checker's error", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    form.set("lambda", "2");
    CHECK_FALSE(form.valid());
    CHECK_THAT(form.field("lambda").error, Contains("It must be a number"));
    CHECK_THAT(form.field("lambda").error, Contains("0 to 1"));
    CHECK(form.field("iterations").error.empty());
    CHECK_THROWS_AS(form.arguments(), UsageError);
    form.set("lambda", "");
    CHECK(form.valid());
    CHECK_THROWS_AS(form.set("lamda", "1"), UsageError);
}

SCENARIO("Fields without effect are inactive and not given", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    CHECK_FALSE(form.field("margin").active);
    form.set("distance", "margin");
    CHECK(form.field("margin").active);
    form.set("margin", "-1");
    CHECK_FALSE(form.valid());
    form.set("distance", "linear");
    CHECK_FALSE(form.field("margin").active);
    CHECK(form.valid());
    CHECK_FALSE(form.arguments().has("margin"));
}

SCENARIO("A field may need that another one is given", "[window][form]") {
    OperationForm form(find_operation("extract-surface"));
    CHECK_FALSE(form.field("contrast").active);
    form.set("diffusion", "0");
    CHECK_FALSE(form.field("contrast").active);
    form.set("diffusion", "5");
    CHECK(form.field("contrast").active);
    OperationForm clip(find_operation("clip-opening"));
    clip.set("distance", "3");
    CHECK_FALSE(clip.arguments().has("distance"));
    clip.set("tip", "1,2,3");  // what was set while it had no effect is kept
    CHECK(clip.arguments().real("distance") == 3.0);
}

SCENARIO("What the operation decides shows in empty fields", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    CHECK(unset_text(form.field("filter")) == "automatic");
    CHECK(form.set_automatic({{"filter", "taubin"}, {"lambda", 0.123456}, {"rings", 1.0}}));
    CHECK_FALSE(form.set_automatic({{"filter", "taubin"}, {"lambda", 0.123456}, {"rings", 1.0}}));
    CHECK(unset_text(form.field("filter")) == "automatic: taubin");
    CHECK(unset_text(form.field("lambda")) == "automatic: 0.123");
    CHECK(unset_text(form.field("rings")) == "1");  // its default
    CHECK(form.arguments() == Arguments{});
    THEN("fields apply as it decides") {
        CHECK(form.field("mu").active);
        CHECK_FALSE(form.field("beta").active);
        form.set("filter", "laplace-hc");
        CHECK_FALSE(form.field("mu").active);
        CHECK(form.field("beta").active);
    }
    THEN("a decision that is not known any more is not shown") {
        CHECK(form.set_automatic({}));
        CHECK(unset_text(form.field("filter")) == "automatic");
    }
    CHECK(unset_text(OperationForm(find_operation("load-surface")).field("file")) == "required");
}

SCENARIO("A form misses required parameters", "[window][form]") {
    const OperationForm form(find_operation("load-surface"));
    CHECK_FALSE(form.valid());
    CHECK_THAT(form.error(), Contains("'file' is required"));
    CHECK(form.field("file").error.empty());
}

SCENARIO("A form shows its command", "[window][form]") {
    OperationForm form(find_operation("smooth"));
    form.set("lambda", "0.5");
    CHECK(form.as_command("/data/it's a case.vbench", "cfd") ==
          R"(vesselbench apply '/data/it'\''s a case.vbench' smooth lambda=0.5 --variant cfd)");
    OperationForm remesh(find_operation("remesh"));
    CHECK(remesh.as_command("a.vbench", "rp") == "vesselbench apply a.vbench remesh --variant rp");
    EditRecord edit{.edit = {.id = 3, .revision = 2}, .operation = "smooth"};
    edit.given = {{"iterations", Value(std::int64_t{7})}};
    const OperationForm change(find_operation("smooth"), edit);
    CHECK(change.edit() == 3);
    CHECK(change.field("iterations").text == "7");
    CHECK(change.as_command("a.vbench", "cfd") == "vesselbench change a.vbench 3 iterations=7");
}
