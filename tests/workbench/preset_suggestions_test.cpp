#include "workbench/suggest/preset_suggestions.h"

#include <array>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

std::vector<PresetSuggestion> presets_of(const Scene& scene, const Arguments& given) {
    std::vector<PresetSuggestion> found;
    suggest_presets(find_operation("smooth"), scene, given,
                    [&](PresetSuggestion one) { found.push_back(std::move(one)); }, {});
    return found;
}

Scene tube() {
    Scene scene;
    scene.surface = fine_tube(4.0, 30.0, 24);
    return scene;
}

}  // namespace

SCENARIO("Three suggestions smooth more and more, as the operation does", "[workbench][suggest]") {
    const Scene scene = tube();
    const Arguments given =
        GENERATE(Arguments(), Arguments{{"filter", std::string("taubin")}},
                 Arguments{{"filter", std::string("laplace")}, {"caps", std::string("round")}});
    const auto found = presets_of(scene, given);
    REQUIRE(found.size() == 3);
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i].tau == std::array{0.3, 0.6, 1.0}[i]);
        if (i > 0) CHECK(found[i].curvature_percent <= found[i - 1].curvature_percent + 1e-9);
        const Outcome made = run("smooth", scene, found[i].arguments);
        CHECK(made.scene.surface->points() == found[i].surface.points());
    }
}

SCENARIO("Values of the filter that were given are searched, others are kept",
         "[workbench][suggest]") {
    const Scene scene = tube();
    const auto free = presets_of(scene, {});
    const auto given = presets_of(scene, {{"iterations", std::int64_t{1}}, {"lambda", 0.01}});
    REQUIRE(free.size() == given.size());
    for (std::size_t i = 0; i < free.size(); ++i) CHECK(free[i].arguments == given[i].arguments);
    const auto caps = presets_of(scene, {{"caps", std::string("smooth")}});
    CHECK(caps.front().arguments.text("caps") == "smooth");
}

SCENARIO("A search for three suggestions is cancelled", "[workbench][suggest]") {
    std::stop_source stop;
    int received = 0;
    const auto receive = [&](const PresetSuggestion&) {
        ++received;
        stop.request_stop();
    };
    CHECK_THROWS_AS(suggest_presets(find_operation("smooth"), tube(), {}, receive,
                                    Progress(nullptr, stop.get_token())),
                    Cancelled);
    CHECK(received == 1);
}
