// Doubts about vessel ends, some of which were answered.

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/forked_vessel.h"
#include "tests/support/iso_surface.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// Two flat ends at z = -15 and z = 25, and two knobs that may be aneurysms or trunks.
Surface two_knobs() {
    const auto body = [](const Vec3& p) {
        const double vessels = std::min({capsule(p, Vec3(0, 0, -18), Vec3(0, 0, 28), 1.6),
                                         capsule(p, Vec3::Zero(), Vec3(6, 0, 0), 2.0),
                                         capsule(p, Vec3(0, 0, 10), Vec3(-6, 0, 10), 2.0)});
        return std::max(vessels, std::abs(p.z() - 5.0) - 20.0);
    };
    return iso_surface(body, {Vec3(-11, -5, -16), Vec3(11, 5, 26)}, 0.3);
}

std::vector<Diagnostic> doubts_of(const Surface& surface, const OpeningPlanOptions& options) {
    const auto graph = centerlines_of(surface);
    try {
        check_flow(plan_openings(surface, *graph, options), surface, *graph, options);
    } catch (const DiagnosedFailure& failure) {
        return failure.diagnostics();
    }
    return {};
}

Positions points_in(const std::string& text) {
    std::vector<double> numbers;
    std::size_t at = 0;
    for (std::size_t end = 0; at < text.size(); at = end + 1) {
        end = std::min(text.find(',', at), text.size());
        numbers.push_back(std::stod(text.substr(at, end - at)));
    }
    Positions points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

bool names(const Positions& places, const Vec3& end) {
    return std::ranges::any_of(places, [&](const Vec3& p) { return (p - end).norm() < 0.01; });
}

}  // namespace

SCENARIO("After one doubt was answered by its place, the next one is answered with both places",
         "[geometry][openings]") {
    const Surface surface = two_knobs();
    const std::vector<Diagnostic> first = doubts_of(surface, {});
    REQUIRE(first.size() == 2);
    const auto& numbers = first.front().remedies.front().arguments;
    CHECK((numbers.contains("open_ends") || numbers.contains("close_ends")));
    for (const bool open : {true, false}) {
        CAPTURE(open);
        const Vec3 answered = *first.front().place, other = *first.back().place;
        OpeningPlanOptions options;
        (open ? options.open : options.closed).push_back(answered);
        const std::vector<Diagnostic> second = doubts_of(surface, options);
        REQUIRE(second.size() == 1);
        REQUIRE(second.front().remedies.size() == 2);
        CHECK(second.front().remedies.back().arguments.contains("accept_doubts"));
        const auto& places = second.front().remedies.front().arguments;
        for (const auto& [name, points] : places) {
            CAPTURE(name, points);
            CHECK((name == "open" || name == "closed"));
        }
        options.open = places.contains("open") ? points_in(places.at("open")) : Positions();
        options.closed = places.contains("closed") ? points_in(places.at("closed")) : Positions();
        CHECK(names(open ? options.open : options.closed, answered));
        CHECK(options.open.size() + options.closed.size() == 2);
        CHECK(names(options.open, other) != names(options.closed, other));
        CHECK(doubts_of(surface, options).empty());
    }
}

SCENARIO("An end that was to be opened and cannot be is left closed by what is offered",
         "[geometry][openings]") {
    const Surface surface = forked_vessel(1.5, 1.2);
    const auto graph = centerlines_of(surface);
    const OpeningPlan plan = plan_openings(surface, *graph);
    const auto daughter =
        std::ranges::find_if(plan.ends, [](const EndRecord& end) { return end.place.z() > 0.0; });
    REQUIRE(daughter != plan.ends.end());
    const Vec3 other = std::ranges::find_if(plan.ends, [&](const EndRecord& end) {
                           return end.place.z() > 0.0 && &end != &*daughter;
                       })->place;
    OpeningPlanOptions options{.open = {daughter->place, other}};
    std::vector<Diagnostic> found;
    for (int tries = 0; tries < 100 && found.empty(); ++tries) try {
            for (const PlannedOpening& opening : plan_openings(surface, *graph, options).openings)
                if ((opening.place.tip - daughter->place).norm() < 2.0)
                    options.failed.push_back({opening.place.tip, opening.place.plane.point,
                                              plain_text("the rim tears")});
        } catch (const DiagnosedFailure& failure) {
            found = failure.diagnostics();
        }
    REQUIRE(found.size() == 1);
    CHECK(found[0].code == "end-cannot-be-opened");
    CHECK(found[0].words.at("why") == "the rim tears");
    REQUIRE(found[0].remedies.size() == 1);
    const auto& offered = found[0].remedies[0].arguments;
    OpeningPlanOptions closed{.open = points_in(offered.at("open")),
                              .closed = points_in(offered.at("closed")),
                              .failed = options.failed};
    CHECK(closed.open.size() == 1);
    CHECK(names(closed.open, other));
    CHECK(names(closed.closed, daughter->place));
    CHECK(why_no_flow(plan_openings(surface, *graph, closed)).empty());
}

SCENARIO("A trunk that cannot be opened is not offered to be closed", "[geometry][openings]") {
    const Surface surface = forked_vessel(1.5, 1.2);
    const auto graph = centerlines_of(surface);
    const Vec3 trunk(0, 0, -18);
    OpeningPlanOptions options{.open = {trunk}};
    std::vector<Diagnostic> found;
    for (int tries = 0; tries < 100 && found.empty(); ++tries) try {
            for (const PlannedOpening& opening : plan_openings(surface, *graph, options).openings)
                if ((opening.place.tip - trunk).norm() < 3.0)
                    options.failed.push_back({opening.place.tip, opening.place.plane.point,
                                              plain_text("the rim tears")});
        } catch (const DiagnosedFailure& failure) {
            found = failure.diagnostics();
        }
    REQUIRE(found.size() == 1);
    CHECK(found[0].remedies.empty());
    CHECK_THAT(text_of(found[0]), Contains("the rim tears") && Contains("end across the vessel"));
}
