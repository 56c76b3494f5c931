#include "workbench/session/scene_cache.h"

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;

SCENARIO("The scene cache keeps to its bytes", "[session][scene_cache]") {
    Scene scene;
    scene.surface = test::icosphere(10.0, 4);
    const std::size_t shape = scene.surface->vertex_count() * 24;
    SceneCache measure(1);
    measure.put(1, scene);
    const std::size_t first = measure.bytes();
    SceneCache cache(first + 5 * shape + 100);
    for (ResultId id = 1; id <= 20; ++id) {
        Scene moved = scene;
        moved.surface = test::mapped(
            *scene.surface, [&](const Vec3& p) { return Vec3(static_cast<double>(id) * p); });
        cache.put(id, moved);
        CHECK(cache.bytes() <= first + 5 * shape + 100);
    }
    THEN("a shared topology counts once") {
        CHECK(cache.size() == 6);
    }
    THEN("the ones used last are there") {
        CHECK(cache.find(20));
        CHECK(cache.find(15));
        CHECK_FALSE(cache.find(14));
    }
    THEN("the newest stays, however large") {
        SceneCache tiny(1);
        tiny.put(1, scene);
        tiny.put(2, scene);
        CHECK(tiny.size() == 1);
        CHECK(tiny.find(2));
    }
}
