#include "geometry/image/histogram.h"

#include <numeric>

#include <catch2/catch.hpp>

#include "tests/support/image_shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A histogram counts all voxels but a few of the farthest", "[images][histogram]") {
    // Values 0 to 39, and two voxels far off.
    const Image image = image_of({40, 40, 40}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        if (p.y() == 7.0 && p.z() == 7.0 && p.x() < 2.0) return p.x() == 0.0 ? -1e4 : 1e4;
        return p.x();
    });
    const ImageHistogram histogram = histogram_of(image, 20);
    CHECK(histogram.least == Approx(0.0).margin(0.5));
    CHECK(histogram.most == Approx(39.0).margin(0.5));
    REQUIRE(histogram.counts.size() == 20);
    CHECK(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}) ==
          40 * 40 * 40 - 2);
    for (const std::size_t count : histogram.counts) CHECK(count == Approx(3200).epsilon(0.51));
}

SCENARIO("An image of one value has no classes", "[images][histogram]") {
    const Image image =
        image_of({4, 4, 4}, Eigen::Matrix4d::Identity(), [](const Vec3&) { return 3.0; });
    const ImageHistogram histogram = histogram_of(image, 8);
    CHECK(histogram.counts.empty());
    CHECK(histogram.least == 3.0);
    CHECK(histogram.most == 3.0);
}
