#include "gpu/context.h"

#include <optional>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/fence.h"
#include "gpu/gpu_smoother.h"
#include "tests/gpu/device_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("Destroying a context makes the previous one current", "[gpu][context]") {
    const auto test = test_device();
    if (!test) return;
    const std::vector<float> values = {1.0F, 2.0F};
    const Buffer buffer = make_storage(test->device, std::span<const float>(values), "values");
    {
        const OffscreenContext other;
        CHECK(current_device().limits.renderer == test->context.renderer());
    }
    CHECK(read_storage<float>(test->device, buffer, 2) == values);
    OffscreenContext third;
    third.release();
    CHECK(read_storage<float>(test->device, buffer, 2) == values);
}

SCENARIO("A fence orders the commands of two threads' contexts", "[gpu][context]") {
    const auto test = test_device();
    if (!test) return;
    constexpr std::size_t kWords = 1 << 20;
    OffscreenContext shared(Sharing::WithCurrent);
    shared.release();
    const Buffer buffer = make_storage(test->device, kWords * 4, "words");
    fill_storage(test->device, buffer, 1);
    std::optional<Fence> ready(std::in_place), filled;
    std::thread worker([&] {
        shared.make_current();
        const Device device = current_device();
        ready->order();
        const auto before = read_storage<std::uint32_t>(device, buffer, kWords);
        CHECK(before == std::vector<std::uint32_t>(kWords, 1));
        for (std::uint32_t word = 2; word <= 50; ++word) fill_storage(device, buffer, word);
        filled.emplace();
        shared.release();
    });
    worker.join();
    filled->order();
    CHECK(read_storage<std::uint32_t>(test->device, buffer, kWords) ==
          std::vector<std::uint32_t>(kWords, 50));
    CHECK(filled->reached());
}

SCENARIO("Another thread smooths what the first one sees", "[gpu][context]") {
    const auto test = test_device();
    if (!test) return;
    const Surface sphere = icosphere(5.0, 3);
    OffscreenContext shared(Sharing::WithCurrent);
    shared.release();
    const auto on_device = uploaded(*test, sphere);
    GpuSmoother smoother(on_device, {});
    const Fence uploaded_all;
    std::optional<Fence> smoothed;
    std::thread worker([&] {
        shared.make_current();
        uploaded_all.order();
        smoother.start(LaplaceParameters{});
        smoother.run(10);
        smoothed.emplace();
        shared.release();
    });
    worker.join();
    smoothed->order();
    const Positions wanted =
        apply_filter(*sphere.topology, sphere.points(), LaplaceParameters{}, {.iterations = 10});
    CHECK(relative_distances(wanted, smoother.positions()).back() <= 2e-6);
    CHECK(relative_distances(sphere.points(), smoother.positions()).back() > 1e-3);
}

SCENARIO("Without a context there is nothing to share with", "[gpu][context]") {
    CHECK_THROWS_AS(OffscreenContext(Sharing::WithCurrent), GpuUnavailable);
}
