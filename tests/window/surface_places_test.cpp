#include "workbench/window/case/surface_places.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "workbench/session/task.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

bool wait_for(Task<SurfacePlaces>& search) {
    for (int i = 0; i < 4000 && search.pending(); ++i) {
        static_cast<void>(search.poll());
        std::this_thread::sleep_for(5ms);
    }
    return !search.pending();
}

}  // namespace

SCENARIO("A tube's openings and ends are its places", "[window][picking]") {
    const SurfacePlaces places = places_of(fine_tube(4, 30, 24), true, {});
    REQUIRE(places.openings.size() == 2);
    CHECK(places.openings[0].name == "inlet");
    CHECK_THAT(opening_text(places.openings[0]), Contains("inlet: diameter 7.9"));
    CHECK_THAT(opening_text(places.openings[0]), Contains("mm\u00B2"));
    REQUIRE(places.tips.size() == 2);
    CHECK(places.tips[0].reach == Approx(8).epsilon(0.1));
    CHECK(opening_of(places, 1)->name == "inlet");
    CHECK(opening_of(places, 0) == nullptr);
    THEN("ends that are open are no further places") {
        const auto all = openings_and_tips(places);
        REQUIRE(all.size() == 2);
        CHECK_THAT(all[1].name, Contains("outlet_1"));
    }
    THEN("a closed vessel's ends are its future openings") {
        CHECK(openings_and_tips({.tips = places.tips}).size() == 2);
    }
}

SCENARIO("Without centerlines the reason is known", "[window][picking]") {
    CHECK(places_of(icosphere(5, 1), false, {}).problem.empty());
    Surface flat = make_surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    CHECK_FALSE(places_of(flat, true, {}).problem.empty());
}

SCENARIO("A click means the nearest place, or the surface", "[window][picking]") {
    const std::vector<NamedPlace> offered = {{{0, 0, 0}, "a", 2.0}, {{3, 0, 0}, "b", 2.0}};
    CHECK_FALSE(pick_spot(offered, std::nullopt, std::nullopt));
    CHECK(pick_spot(offered, std::nullopt, 1)->point == Vec3(3, 0, 0));
    CHECK(pick_spot(offered, Vec3(0.5, 0, 0), 1)->place == 1U);
    CHECK(pick_spot(offered, Vec3(1.4, 0, 0), std::nullopt)->place == 0U);
    CHECK(pick_spot(offered, Vec3(1.6, 0, 0), std::nullopt)->place == 1U);
    const auto dome = pick_spot(offered, Vec3(0, 9, 0), std::nullopt);
    REQUIRE(dome);
    CHECK_FALSE(dome->place);
    CHECK(dome->point == Vec3(0, 9, 0));
    CHECK(pick_spot({}, Vec3(1, 2, 3), std::nullopt)->point == Vec3(1, 2, 3));
}

SCENARIO("Places are searched on another thread", "[window][picking]") {
    std::atomic<int> woken = 0;
    Task<SurfacePlaces> search([&] { ++woken; });
    const auto begin = [&](const Surface& surface) {
        search.start(
            [surface](const Progress& progress) { return places_of(surface, true, progress); });
    };
    begin(fine_tube(4, 30, 24));
    CHECK(search.pending());
    WHEN("it ends") {
        REQUIRE(wait_for(search));
        CHECK(search.newest()->tips.size() == 2);
        while (woken == 0) std::this_thread::sleep_for(1ms);
        CHECK(woken == 1);
    }
    WHEN("another surface is shown meanwhile") {
        begin(fine_tube(4, 40, 24));
        REQUIRE(wait_for(search));
        REQUIRE(search.newest()->openings.size() == 2);
        CHECK(search.newest()->openings[1].centroid.z() == Approx(40));
    }
    WHEN("nothing is shown meanwhile") {
        search.forget();
        REQUIRE(wait_for(search));
        CHECK(search.newest() == nullptr);
    }
}
