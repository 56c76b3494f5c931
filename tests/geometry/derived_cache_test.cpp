#include "geometry/kernel/derived_cache.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/surface_key.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// The same content in new arrays.
Surface copy_of(const Surface& surface) {
    return make_surface(surface.points(), {surface.triangles().begin(), surface.triangles().end()},
                        *surface.patch_labels, surface.patches);
}

ContentKey number_key(std::uint64_t number) {
    return {0, number};
}

/// Derives `number` from itself, at `bytes` each.
std::shared_ptr<const int> number_in(DerivedCache& cache, int number, std::size_t bytes,
                                     int& made) {
    return cache.find_or_make<int>(
        "number", number_key(static_cast<std::uint64_t>(number)),
        [&] {
            ++made;
            return number;
        },
        [&](int) { return bytes; });
}

}  // namespace

SCENARIO("Content keys stand for contents", "[geometry][derived_cache]") {
    const Surface sphere = icosphere(10.0, 2);
    DerivedCache cache;
    const ContentKey key = shape_key(sphere, cache);
    CHECK(shape_key(sphere, cache) == key);
    CHECK(shape_key(copy_of(sphere), cache) == key);
    CHECK(shape_key(sphere.points(), sphere.triangles()) == key);
    CHECK(shape_key(*sphere.topology, sphere.points()) == key);
    WHEN("one coordinate changes by one bit") {
        Positions points = sphere.points();
        points.back().z() = std::nextafter(points.back().z(), 1e9);
        CHECK(shape_key(sphere.with_positions(points), cache) != key);
    }
    WHEN("one triangle is turned, or a vertex added that no triangle uses") {
        std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
        Positions points = sphere.points();
        points.emplace_back(0, 0, 0);
        CHECK(shape_key(make_surface(points, triangles), cache) != key);
        std::swap(triangles[7][0], triangles[7][1]);
        CHECK(shape_key(make_surface(sphere.points(), triangles), cache) != key);
    }
    WHEN("only a patch's label, kind or name changes") {
        const ContentKey whole = surface_key(sphere, cache);
        CHECK(surface_key(copy_of(sphere), cache) == whole);
        PatchLabels labels = *sphere.patch_labels;
        const std::vector<Patch> two = {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}};
        const ContentKey relabelled = surface_key(sphere.with_patches(labels, two), cache);
        CHECK(relabelled != whole);
        labels[3] = 1;
        CHECK(surface_key(sphere.with_patches(labels, two), cache) != relabelled);
        CHECK(shape_key(sphere.with_patches(labels, two), cache) == key);
    }
    WHEN("the content is larger than what one thread takes at a time") {
        std::vector<double> many(500000, 1.0);
        const ContentKey first = content_key(std::span<const double>(many));
        CHECK(content_key(std::span<const double>(std::vector<double>(many))) == first);
        many[400000] = 2.0;
        CHECK(content_key(std::span<const double>(many)) != first);
    }
    WHEN("an array is gone and its memory used again") {
        // 500 surfaces one after the other: their arrays get the same addresses again and again
        std::vector<ContentKey> keys;
        for (int i = 0; i < 500; ++i) {
            Positions points = sphere.points();
            points[0].x() += i;
            keys.push_back(shape_key(make_surface(std::move(points), {sphere.triangles().begin(),
                                                                      sphere.triangles().end()}),
                                     cache));
        }
        std::sort(keys.begin(), keys.end());
        CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
    }
    CHECK_THROWS_AS(shape_key(Surface{}, cache), InvalidInput);
}

SCENARIO("Derived things are found by content", "[geometry][derived_cache]") {
    DerivedCache cache;
    const Surface tube = closed_tube(2.0, 20.0, 24, 30);
    const SurfaceDistance built = distance_to(tube, cache);
    REQUIRE(cache.size() == 1);
    CHECK(cache.bytes() == built.bytes());
    THEN("other arrays of the same content hit") {
        static_cast<void>(distance_to(copy_of(tube), cache));
        static_cast<void>(distance_to(tube.points(), tube.triangles(), cache));
        CHECK(cache.size() == 1);
    }
    THEN("a moved vertex misses") {
        Positions moved = tube.points();
        moved[5] += Vec3(0.0, 0.0, 1e-9);
        static_cast<void>(distance_to(tube.with_positions(moved), cache));
        CHECK(cache.size() == 2);
    }
    THEN("topologies of the same triangles share their one-rings") {
        CHECK(&tube.topology->rings() == &copy_of(tube).topology->rings());
        CHECK(&tube.topology->triangles_at() == &copy_of(tube).topology->triangles_at());
    }
}

SCENARIO("What the cache gives is what would be made without it", "[geometry][derived_cache]") {
    DerivedCache cache, none(0);
    const Surface tube = closed_tube(2.0, 30.0, 24, 40);
    const Positions places = icosphere(9.0, 2, {0.5, 0.25, 12.0}).points();
    for (int round = 0; round < 2; ++round) {  // made, then found
        const Surface same = copy_of(tube);
        const auto known = distance_to(same, cache).closest_points(places);
        const auto plain = SurfaceDistance(tube).closest_points(places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            CHECK((known[i].point == plain[i].point));
            CHECK(known[i].triangle == plain[i].triangle);
        }
        CHECK(distance_to(same, cache).signed_distances(places) ==
              SurfaceDistance(tube).signed_distances(places));
        CHECK((*vertex_normals_of(same, cache) == vertex_normals(tube)));
        CHECK(mean_curvature_of(same, cache)->values == mean_curvature(tube).values);
        CHECK(self_intersections(same, {}, cache) ==
              self_intersections(tube.points(), tube.triangles()));
        CHECK(measure(same, cache).normal_curvature_deg ==
              measure(tube, none).normal_curvature_deg);
        CHECK(measure(same, cache).patches.size() == 3);
        const auto lines = centerlines_of(same, {}, {}, cache);
        const CenterlineGraph own = compute_centerlines(tube);
        REQUIRE(lines->branches.size() == own.branches.size());
        CHECK((lines->branches[0].points == own.branches[0].points));
        CHECK(lines->branches[0].radii == own.branches[0].radii);
        CHECK(centerlines_of(same, {.spacing = 0.4}, {}, cache) != lines);
    }
    CHECK(none.size() == 0);
    CHECK(none.bytes() == 0);
}

SCENARIO("A shape known to be free of crossings is not searched again",
         "[geometry][derived_cache]") {
    DerivedCache cache;
    const Surface sphere = icosphere(5.0, 2);
    remember_no_self_intersections(*sphere.topology, sphere.points(), cache);
    REQUIRE(cache.size() == 1);
    CHECK(self_intersections(copy_of(sphere), {}, cache).empty());
    CHECK(cache.size() == 1);
}

SCENARIO("The cache holds what was used last within its bytes", "[geometry][derived_cache]") {
    DerivedCache cache(100);
    int made = 0;
    for (const int number : {1, 2, 3}) static_cast<void>(number_in(cache, number, 30, made));
    REQUIRE(cache.bytes() == 90);
    CHECK(*number_in(cache, 1, 30, made) == 1);  // used: 2 is now the oldest
    CHECK(made == 3);
    const auto held = number_in(cache, 4, 30, made);
    CHECK(cache.bytes() == 90);
    static_cast<void>(number_in(cache, 1, 30, made));
    static_cast<void>(number_in(cache, 3, 30, made));
    CHECK(made == 4);
    static_cast<void>(number_in(cache, 2, 30, made));
    CHECK(made == 5);
    WHEN("something is larger than the whole cache") {
        CHECK(*number_in(cache, 5, 101, made) == 5);
        CHECK(cache.bytes() == 90);  // it evicts nothing
    }
    WHEN("the budget shrinks") {
        cache.set_budget(40);
        CHECK(cache.size() == 1);
        CHECK(cache.bytes() == 30);
        CHECK(*number_in(cache, 2, 30, made) == 2);
        CHECK(made == 5);
    }
    WHEN("it is cleared") {
        cache.clear();
        CHECK(cache.size() == 0);
        CHECK(cache.bytes() == 0);
        CHECK(*held == 4);
    }
}

SCENARIO("Kinds and types are kept apart", "[geometry][derived_cache]") {
    DerivedCache cache;
    const auto small = [](const auto&) { return std::size_t{8}; };
    const auto one = cache.find_or_make<int>(
        "one", number_key(1), [] { return 1; }, small);
    const auto two = cache.find_or_make<int>(
        "two", number_key(1), [] { return 2; }, small);
    const auto third = cache.find_or_make<double>(
        "one", number_key(1), [] { return 3.0; }, small);
    CHECK(*one == 1);
    CHECK(*two == 2);
    CHECK(*third == 3.0);
}

SCENARIO("What several threads ask for at once is made once", "[geometry][derived_cache]") {
    DerivedCache cache;
    std::atomic<int> made{0}, ready{0};
    std::vector<std::shared_ptr<const int>> found(8);
    std::vector<std::thread> threads;
    for (auto& one : found)
        threads.emplace_back([&] {
            ++ready;
            while (ready < 8) std::this_thread::yield();
            one = cache.find_or_make<int>(
                "slow", number_key(7),
                [&] {
                    std::this_thread::sleep_for(std::chrono::milliseconds(50));
                    return ++made;
                },
                [](int) { return std::size_t{1}; });
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(made == 1);
    for (const auto& one : found) CHECK(one == found.front());
}

SCENARIO("What is too large to be kept still serves those that waited for it",
         "[geometry][derived_cache]") {
    DerivedCache cache(0);
    std::atomic<int> made{0};
    std::atomic<bool> begun{false};
    const auto make = [&] {
        begun = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        return ++made;
    };
    const auto ask = [&] {
        return *cache.find_or_make<int>("slow", number_key(7), make,
                                        [](int) { return std::size_t{1}; });
    };
    int first = 0, second = 0;
    std::thread maker([&] { first = ask(); });
    while (!begun) std::this_thread::yield();
    std::thread waiter([&] { second = ask(); });
    maker.join();
    waiter.join();
    CHECK(first == 1);
    CHECK(second == 1);
    CHECK(cache.size() == 0);
}

SCENARIO("An exception reaches its caller and is not kept", "[geometry][derived_cache]") {
    DerivedCache cache;
    const auto one_byte = [](int) { return std::size_t{1}; };
    const auto fail = []() -> int { throw AlgorithmFailure("no lumen"); };
    CHECK_THROWS_AS(cache.find_or_make<int>("failing", number_key(1), fail, one_byte),
                    AlgorithmFailure);
    CHECK(cache.size() == 0);
    CHECK(*cache.find_or_make<int>(
              "failing", number_key(1), [] { return 5; }, one_byte) == 5);
}

SCENARIO("Cancelling one that asks takes nothing from the others", "[geometry][derived_cache]") {
    DerivedCache cache;
    const auto one_byte = [](int) { return std::size_t{1}; };
    std::atomic<bool> begun{false}, done{false};
    GIVEN("a maker that is cancelled while another one waits") {
        std::stop_source stop;
        std::thread maker([&] {
            const Progress progress(nullptr, stop.get_token());
            const auto make = [&]() -> int {
                begun = true;
                for (;;) progress.check_cancelled();
            };
            try {
                static_cast<void>(
                    cache.find_or_make<int>("slow", number_key(1), make, one_byte, progress));
            } catch (const Cancelled&) {
                done = true;
            }
        });
        while (!begun) std::this_thread::yield();
        int value = 0;
        std::thread waiter([&] {
            value = *cache.find_or_make<int>(
                "slow", number_key(1), [] { return 6; }, one_byte);
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        stop.request_stop();
        maker.join();
        waiter.join();
        THEN("the other one makes it in its place") {
            CHECK(done);
            CHECK(value == 6);
        }
    }
    GIVEN("a waiter that is cancelled") {
        std::atomic<bool> go_on{false};
        int value = 0;
        std::thread maker([&] {
            const auto make = [&] {
                begun = true;
                while (!go_on) std::this_thread::yield();
                return 7;
            };
            value = *cache.find_or_make<int>("slow", number_key(1), make, one_byte);
        });
        while (!begun) std::this_thread::yield();
        std::stop_source stop;
        stop.request_stop();
        const auto start = std::chrono::steady_clock::now();
        CHECK_THROWS_AS(cache.find_or_make<int>(
                            "slow", number_key(1), [] { return 8; }, one_byte,
                            Progress(nullptr, stop.get_token())),
                        Cancelled);
        CHECK(std::chrono::steady_clock::now() - start < std::chrono::milliseconds(300));
        go_on = true;
        maker.join();
        CHECK(value == 7);
    }
}

SCENARIO("Tasks that ask while their thread makes something do not wait for themselves",
         "[geometry][derived_cache]") {
    DerivedCache cache;
    std::atomic<int> made{0};
    tbb::parallel_for(0, 64, [&](int i) {
        const auto make = [&] {
            std::atomic<int> sum{0};
            tbb::parallel_for(0, 1000, [&](int k) { sum += k; });
            ++made;
            return sum.load();
        };
        static_cast<void>(cache.find_or_make<int>("sum",
                                                  number_key(static_cast<std::uint64_t>(i % 4)),
                                                  make, [](int) { return std::size_t{1}; }));
    });
    CHECK(made == 4);
}
