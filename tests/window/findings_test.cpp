#include <algorithm>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/phantoms/phantom.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/findings/findings_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// A tube whose wall is pushed out by two bumps.
std::string bumpy_file() {
    std::string file = temporary_folder() + "/bumpy.stl";
    const Surface tube = mapped(fine_tube(2.0, 30.0, 48), [](const Vec3& p) {
        Vec3 moved = p;
        for (const Vec3& at : {Vec3(2, 0, 10), Vec3(-2, 0, 20)}) {
            const double share = (p - at).norm();
            if (share < 1.0) moved += 0.7 * (1 - share * share) * Vec3(at.x() / 2.0, 0, 0);
        }
        return moved;
    });
    write_surface(tube, file);
    return file;
}

FindingsFeature& findings_of(OffscreenShell& shell) {
    return shell.app().place().get<FindingsFeature>();
}

std::size_t count(OffscreenShell& shell) {
    return findings_of(shell).findings() ? findings_of(shell).findings()->open.size() : 0;
}

void wait_for_findings(OffscreenShell& shell) {
    REQUIRE(shell.run_until([&] { return findings_of(shell).findings().has_value(); }, 60s));
}

}  // namespace

SCENARIO("Findings are toured, treated and dismissed", "[window][findings]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, bumpy_file());
    CHECK_FALSE(findings_of(*shell).findings());  // nobody has asked
    const int looks = shell->app().place().looks();
    shell->press_key(keys::letter('T'));
    wait_for_findings(*shell);
    REQUIRE(count(*shell) == 2);
    CHECK(shell->app().place().looks() == looks + 1);
    CHECK(findings_of(*shell).at() == 0U);
    const Finding first = findings_of(*shell).findings()->open[0];
    CHECK(first.kind == "bump");
    CHECK((*shell->app().place().looked_at() - first.place).norm() < 1e-9);
    WHEN("the keys go on") {
        shell->press_key(keys::letter('T'));
        CHECK(findings_of(*shell).at() == 1U);
        shell->press_key(keys::letter('T'));
        CHECK(findings_of(*shell).at() == 0U);
    }
    WHEN("one is to be changed") {
        REQUIRE(shell->click_item("findings.change.0"));
        THEN("the form has its arguments") {
            REQUIRE(shell->app().place().form());
            CHECK(shell->app().place().form()->operation().name == "brush-smooth");
            CHECK(shell->app().place().command().find("radius=") != std::string::npos);
        }
    }
    WHEN("one is corrected") {
        const auto edits = shell->app().place().document.snapshot()->log.size();
        REQUIRE(shell->click_item("findings.apply.0"));
        REQUIRE(wait_until_idle(*shell));
        CHECK(shell->app().place().document.snapshot()->log.size() == edits + 1);
        CHECK_THAT(shell->app().place().document.snapshot()->log.back().edit.note,
                   Catch::Matchers::StartsWith("Bump: "));
        THEN("the findings are those of the new model") {
            wait_for_findings(*shell);
            for (const Finding& left : findings_of(*shell).findings()->open)
                CHECK((left.place - first.place).norm() > 2.0);
        }
    }
    WHEN("one is kept") {
        REQUIRE(shell->click_item("findings.keep.0"));
        REQUIRE(shell->has("findings.reason"));
        CHECK_FALSE(shell->app().ui().items().at("findings.confirm").enabled);
        REQUIRE(shell->fill_item("findings.reason", "a plaque"));
        REQUIRE(shell->click_item("findings.confirm"));
        REQUIRE(shell->run_until([&] { return count(*shell) == 1; }, 30s));
        THEN("it stays so in the project") {
            const auto kept = stored_dismissals(shell->app().place().document.project());
            REQUIRE(kept.size() == 1);
            CHECK(kept[0].reason == "a plaque");
            CHECK(is_of(kept[0], first));
        }
    }
}

SCENARIO("What may be anatomy is asked, and kept at one click", "[window][findings]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/stub.stl";
    const PhantomDescription phantom{
        .name = "stub",
        .parts = {{.name = "vessel",
                   .shape = VesselShape{.points = {{0, 0, -12}, {1, 2, 12}}, .radii = {2, 2}}},
                  {.name = "stub",
                   .shape =
                       VesselShape{.points = {{0.5, 1, 0}, {-3.5, 1, 0}}, .radii = {0.8, 0.8}}}},
        .imaging = {.spacing = Vec3::Constant(0.4), .margin = 2.0},
        .surface_edge = 1.0};
    write_surface(extract_surface(make_phantom(phantom).image, {}, {.threshold = 500.0}).surface,
                  file);
    open_and_wait(*shell, file);
    const auto edits = shell->app().place().document.snapshot()->log.size();
    REQUIRE(shell->click_item("tab.findings"));
    wait_for_findings(*shell);
    const auto& open = findings_of(*shell).findings()->open;
    const auto asked =
        std::ranges::find_if(open, [](const Finding& f) { return f.kind == "stub"; });
    REQUIRE(asked != open.end());
    const std::size_t all = open.size();
    const std::string row = std::to_string(asked - open.begin());
    CHECK_FALSE(shell->has("findings.apply." + row));
    findings_of(*shell).treat_at_once(static_cast<std::size_t>(asked - open.begin()));
    REQUIRE(wait_until_idle(*shell));
    CHECK(shell->app().place().document.snapshot()->log.size() == edits);
    WHEN("it is kept") {
        REQUIRE(shell->click_item("findings.keep." + row));
        REQUIRE(shell->run_until([&] { return count(*shell) + 1 == all; }, 30s));
        THEN("the project has who said so") {
            const auto kept = stored_dismissals(shell->app().place().document.project());
            REQUIRE(kept.size() == 1);
            CHECK_THAT(kept[0].reason, Catch::Matchers::Contains("sac (aneurysm?)"));
        }
    }
    WHEN("it is a stub") {
        REQUIRE(shell->click_item("findings.change." + row));
        THEN("the form is open, for a look at the preview") {
            REQUIRE(shell->app().place().form());
            CHECK(shell->app().place().form()->operation().name == "remove-branch");
        }
    }
}

SCENARIO("A correction that is refused is not offered", "[window][findings]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/narrow.stl";
    write_surface(mapped(closed_tube(2.0, 40.0, 32, 160),
                         [](const Vec3& p) {
                             const double x = std::min(1.0, std::abs(p.z() - 20.0) / 5.0);
                             const double width = 0.6 - 0.4 * std::cos(std::numbers::pi * x);
                             return Vec3(width * p.x(), width * p.y(), p.z());
                         }),
                  file);
    open_and_wait(*shell, file);
    REQUIRE(shell->click_item("tab.findings"));
    wait_for_findings(*shell);
    REQUIRE(count(*shell) > 0);
    CHECK(findings_of(*shell).findings()->open[0].kind == "narrowing");
    CHECK(shell->app().ui().items().at("findings.change.0").enabled);
    REQUIRE(shell->click_item("findings.look.0"));
    REQUIRE(shell->run_until([&] { return findings_of(*shell).refusal(0) != nullptr; }, 60s));
    CHECK_THAT(*findings_of(*shell).refusal(0), Catch::Matchers::Contains("nearly closed"));
    const auto& items = shell->app().ui().items();
    CHECK(shell->run_until([&] { return !items.at("findings.change.0").enabled; }, 10s));
    CHECK(items.at("findings.keep.0").enabled);
}

SCENARIO("Findings that are more likely wrong than right are unfolded by a click",
         "[window][findings]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/low.stl";
    write_surface(mapped(fine_tube(2.0, 30.0, 48),
                         [](const Vec3& p) {
                             const double share = (p - Vec3(2, 0, 10)).norm();
                             const double up = share < 1.0 ? 0.22 * (1 - share * share) : 0.0;
                             return Vec3(p + up * Vec3::UnitX());
                         }),
                  file);
    open_and_wait(*shell, file);
    REQUIRE(shell->click_item("tab.findings"));
    wait_for_findings(*shell);
    REQUIRE(count(*shell) > 0);
    REQUIRE(findings_of(*shell).listed() < count(*shell));
    REQUIRE(shell->click_item("findings.more"));
    CHECK(findings_of(*shell).listed() == count(*shell));
    REQUIRE(shell->run_until([&] { return shell->has("findings.keep.0"); }, 5s));
}

SCENARIO("Closing a case ends the search for findings", "[window][findings]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, bumpy_file());
    REQUIRE(shell->click_item("tab.findings"));
    shell->app().place().close();
    REQUIRE(shell->settle(60s));
    CHECK_FALSE(findings_of(*shell).findings());
    CHECK_FALSE(findings_of(*shell).pending());
}
