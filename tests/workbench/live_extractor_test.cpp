#include "workbench/operations/extract_surface/live_extractor.h"

#include <stop_token>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t kFew = 25'000;  ///< voxels of the coarse image

CheckedArguments given(const Arguments& arguments) {
    return checked_arguments(find_operation("extract-surface"), arguments);
}

Surface extracted(const Image& image, const std::optional<Image>& mask,
                  const Arguments& arguments) {
    Scene scene;
    scene.image = image;
    scene.mask = mask;
    return *run("extract-surface", scene, arguments).scene.surface;
}

/// Two balls of 6 and 4 mm, bright as `bright`, on 0.
Image two_balls(double bright) {
    return image_of({60, 40, 40}, Eigen::Matrix4d::Identity(), [&](const Vec3& p) {
        const double inside =
            std::max(6.0 - (p - Vec3(18, 20, 20)).norm(), 4.0 - (p - Vec3(42, 20, 20)).norm());
        return bright * std::clamp(0.5 + 0.5 * inside, 0.0, 1.0);
    });
}

}  // namespace

SCENARIO("The whole preview is what extract-surface makes", "[live][extraction]") {
    const Image image = two_balls(100.0);
    LiveExtractor live(image, {}, kFew);
    for (const Arguments& arguments :
         {Arguments{}, Arguments{{"threshold", 40.0}}, Arguments{{"iso", 60.0}},
          Arguments{{"threshold", 40.0}, {"component", std::string("all")}},
          Arguments{{"threshold", 40.0}, {"seed", Vec3(42, 20, 20)}},
          Arguments{{"threshold", 40.0}, {"gaussian", 1.0}}}) {
        const auto state = live.whole(given(arguments), {});
        const Surface expected = extracted(image, {}, arguments);
        CHECK(state.whole);
        CHECK(state.surface.points() == expected.points());
        CHECK(std::ranges::equal(state.surface.triangles(), expected.triangles()));
        const auto coarse = live.coarse(given(arguments), {});
        REQUIRE(coarse);
        CHECK_FALSE(coarse->whole);
        CHECK(coarse->threshold == state.threshold);
        CHECK(coarse->bodies == state.bodies);
        CHECK(volume(coarse->surface) == Approx(volume(state.surface)).epsilon(0.1));
        CHECK(coarse->surface.triangle_count() < state.surface.triangle_count() / 2);
    }
}

SCENARIO("A coarse preview follows the side, the mask and the cleaning", "[live][extraction]") {
    const auto volumes = [](LiveExtractor& live, const Arguments& arguments) {
        const auto coarse = live.coarse(given(arguments), {});
        REQUIRE(coarse);
        return std::pair(volume(coarse->surface), volume(live.whole(given(arguments), {}).surface));
    };
    GIVEN("a vessel of low values") {
        LiveExtractor live(two_balls(-100.0), {}, kFew);
        const auto [rough, fine] =
            volumes(live, {{"threshold", -50.0}, {"inside", std::string("below")}});
        CHECK(rough == Approx(fine).epsilon(0.1));
        CHECK(fine < 1200.0);
    }
    GIVEN("a mask of the small ball") {
        const Image image = two_balls(100.0);
        const Image mask = image_of(image.size, image.index_to_patient, [](const Vec3& p) {
            return (p - Vec3(42, 20, 20)).norm() < 4.0 ? 1.0 : 0.0;
        });
        LiveExtractor live(image, mask, kFew);
        const auto [rough, fine] = volumes(live, {{"dilation", std::int64_t{3}}});
        CHECK(rough == Approx(fine).epsilon(0.15));
        CHECK(fine < 350.0);
        CHECK(live.whole(given({}), {}).surface.points() == extracted(image, mask, {}).points());
    }
    GIVEN("cleaning that removes a thin bridge") {
        const Image balls = two_balls(100.0);
        const Image image = image_of(balls.size, balls.index_to_patient, [&](const Vec3& p) {
            const bool bridge =
                p.x() > 18 && p.x() < 42 && p.y() == 20.0 && std::abs(p.z() - 20.0) <= 1.0;
            const Vec3 at = p;
            return bridge ? 100.0
                          : static_cast<double>(balls.at(static_cast<int>(at.x()),
                                                         static_cast<int>(at.y()),
                                                         static_cast<int>(at.z())));
        });
        LiveExtractor live(image, {}, kFew);
        const Arguments cleaned = {{"threshold", 40.0}, {"opening", std::int64_t{2}}};
        CHECK(live.whole(given({{"threshold", 40.0}}), {}).bodies == 1);
        CHECK(live.whole(given(cleaned), {}).bodies == 2);
        CHECK(live.coarse(given(cleaned), {})->bodies == 2);
    }
}

SCENARIO("Where a coarse image does not serve there is no coarse preview", "[live][extraction]") {
    const Image image = two_balls(100.0);
    CHECK_FALSE(LiveExtractor(image, {}).has_coarse());
    CHECK_FALSE(LiveExtractor(image, {}).coarse(given({}), {}));
    LiveExtractor live(image, {}, kFew);
    REQUIRE(live.has_coarse());
    THEN("a value that nothing has fails as the operation does") {
        const auto wrong = given({{"threshold", 1000.0}});
        CHECK_FALSE(live.coarse(wrong, {}));
        CHECK_THROWS_WITH(live.whole(wrong, {}), Contains("no voxel is inside"));
        AND_THEN("the next value works") {
            CHECK(live.coarse(given({{"threshold", 50.0}}), {}));
        }
    }
    THEN("a cancelled preview leaves it usable") {
        std::stop_source stop;
        stop.request_stop();
        const auto arguments = given({{"threshold", 50.0}, {"gaussian", 1.0}});
        CHECK_THROWS_AS(live.coarse(arguments, Progress(nullptr, stop.get_token())), Cancelled);
        CHECK_THROWS_AS(live.whole(arguments, Progress(nullptr, stop.get_token())), Cancelled);
        CHECK(live.whole(arguments, {}).surface.points() ==
              extracted(image, {}, {{"threshold", 50.0}, {"gaussian", 1.0}}).points());
    }
    THEN("labels have no iso-value") {
        const Image labels = image_of({60, 40, 40}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
            return (p - Vec3(30, 20, 20)).norm() < 8.0 ? 2.0 : 0.0;
        });
        LiveExtractor of_labels(labels, {}, kFew);
        CHECK_FALSE(of_labels.coarse(given({}), {}));
        CHECK_FALSE(of_labels.whole(given({}), {}).threshold);
    }
}
