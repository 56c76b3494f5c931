#include "workbench/window/drawing/model_drawing.h"

#include <chrono>
#include <memory>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/gpu/watched_context.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

std::unique_ptr<WatchedContext> context() {
    try {
        return std::make_unique<WatchedContext>();
    } catch (const GpuUnavailable& error) {
        skip(error.what());
        return nullptr;
    }
}

bool is_laid_out(ModelDrawing& model) {
    for (const auto end = std::chrono::steady_clock::now() + 60s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(1ms)) {
        static_cast<void>(model.update());
        if (!model.pending()) return true;
    }
    return false;
}

}  // namespace

SCENARIO("A stroke that was entered is not laid out again", "[window][strokes]") {
    const auto device = context();
    if (!device) return;
    Scene before;
    before.surface = fine_tube(4.0, 30.0, 24);
    Positions points = before.surface->points();
    points[7] *= 1.1;
    Scene after;
    after.surface = before.surface->with_positions(std::move(points));
    ModelDrawing model({});
    model.show(&before);
    REQUIRE(is_laid_out(model));
    model.move({.before = before, .after = after, .changed = {7}});
    REQUIRE(model.surface()->positions == after.surface->positions);
    model.show(&after);
    CHECK_FALSE(model.pending());
    CHECK(model.surface()->positions == after.surface->positions);
    WHEN("it is undone") {
        model.show(&before);
        CHECK(model.pending());
        REQUIRE(is_laid_out(model));
        CHECK(model.surface()->positions == before.surface->positions);
    }
}
