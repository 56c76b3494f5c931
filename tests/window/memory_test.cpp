// What a closed case leaves in memory.

#include <memory>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/surface_key.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/extraction/extraction_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// The shared parts of a scene, without holding them.
struct SceneParts {
    std::weak_ptr<const void> positions, topology, voxels;

    explicit SceneParts(const Scene& scene) {
        if (scene.surface) {
            positions = scene.surface->positions;
            topology = scene.surface->topology;
        }
        if (scene.image) voxels = scene.image->voxels;
    }

    [[nodiscard]] bool released() const {
        return positions.expired() && topology.expired() && voxels.expired();
    }
};

/// Threads that were still at work on it let go a little later.
bool releases_when_closed(OffscreenShell& shell, const SceneParts& parts) {
    shell.app().place().close();
    return shell.settle(60s) && shell.run_until([&] { return parts.released(); }, 20s);
}

}  // namespace

SCENARIO("A closed document holds nothing of its case", "[window][memory]") {
    Document document({.session = session_options(), .documents = temporary_folder()});
    document.open({.path = tube_file(120)});
    while (!document.is_open() || document.busy() || document.shown() == nullptr) document.poll();
    document.want_deviation(true);
    document.apply("smooth", {{"iterations", Value(std::int64_t{2})}}, Step::Smoothing);
    do document.poll();
    while (document.busy());
    const SceneParts parts(*document.shown());
    REQUIRE_FALSE(parts.released());
    static_cast<void>(shape_key(*document.shown()->surface));
    document.close();
    while (document.busy()) document.poll();
    CHECK(parts.released());
    CHECK(derived_cache().bytes() == 0);
    CHECK(derived_cache().size() == 0);
}

SCENARIO("A window holds nothing of a closed case", "[window][memory]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, tube_file(120));
    Workplace& place = shell->app().place();
    SECTION("that was looked at") {
        place.view.choose(ColouringKind::MeanCurvature);
        place.settings.layers.centerlines = true;
        REQUIRE(shell->settle(60s));
    }
    SECTION("with a form that was followed live") {
        place.choose("smooth");
        place.live().follow(true);
        REQUIRE(shell->settle(60s));
    }
    SECTION("with a measure") {
        shell->press_key(keys::letter('D'));
        REQUIRE(shell->settle(60s));
    }
    SECTION("with a comparison") {
        place.document.apply("smooth", {{"iterations", Value(std::int64_t{1})}}, Step::Smoothing);
        REQUIRE(wait_until_idle(*shell));
        place.get<CompareFeature>().compare(1);
        REQUIRE(shell->settle(60s));
    }
    REQUIRE(place.document.shown() != nullptr);
    const SceneParts parts(*place.document.shown());
    REQUIRE_FALSE(parts.released());
    CHECK(releases_when_closed(*shell, parts));
}

SCENARIO("A window holds nothing of a closed image", "[window][memory]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/image.mha";
    write_image(file, image_of({40, 36, 28}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
                    return (p - Vec3(20, 18, 14)).norm() < 8.0 ? 900.0 : 100.0;
                }));
    open_and_wait(*shell, file);
    Workplace& place = shell->app().place();
    place.choose("extract-surface");
    place.get<ExtractionFeature>().follow(true);
    REQUIRE(shell->settle(60s));
    REQUIRE(place.document.shown() != nullptr);
    const SceneParts parts(*place.document.shown());
    REQUIRE_FALSE(parts.voxels.expired());
    CHECK(releases_when_closed(*shell, parts));
}
