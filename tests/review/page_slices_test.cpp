#include "workbench/review/page_slices.h"

#include <cstdlib>

#include <catch2/catch.hpp>

#include "tests/review/packed_bytes.h"
#include "tests/support/image_shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

Vec3 vector(const Json& json) {
    return Vec3(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

/// Values grow along x, in steps that are no labels.
Image ramp() {
    Eigen::Matrix4d matrix = Eigen::Vector4d(0.5, 0.75, 2.0, 1.0).asDiagonal();
    matrix.topRightCorner<3, 1>() = Vec3(10, 30, -40);
    return image_of({40, 40, 20}, matrix, [](const Vec3& p) { return 0.31 * p.x(); });
}

}  // namespace

SCENARIO("Slices lie where they say, and are cut off around their place", "[review]") {
    const Image image = ramp();
    PageSlices slices(image);
    const Vec3 place(20, 45, -20);
    const Json three = slices.add("7", place, 4.0);
    REQUIRE(three.size() == 3);
    for (const Json& slice : three) {
        const int width = slice["width"], height = slice["height"];
        const Vec3 origin = vector(slice["origin"]), u = vector(slice["u"]), v = vector(slice["v"]);
        const double wide = slice["spacing"][0], high = slice["spacing"][1];
        CHECK(u.norm() == Approx(1.0));
        CHECK(std::abs(u.dot(v)) < 1e-12);
        CHECK(width * wide <= 8.0 + 2 * wide);
        CHECK(height * high <= 8.0 + 2 * high);
        const Vec3 to_place = place - origin;
        CHECK(to_place.dot(u) > -wide);
        CHECK(to_place.dot(u) < width * wide);
        CHECK(to_place.dot(v) > -high);
        CHECK(to_place.dot(v) < height * high);
        const std::string pixels =
            unpacked(slices.blobs().at(slice["blob"]), static_cast<std::size_t>(width) * height);
        const auto value = [&](int column, int row) {
            return static_cast<unsigned char>(
                pixels[static_cast<std::size_t>(row) * width + column]);
        };
        if (std::abs(u.x()) > 0.5) CHECK((value(width - 1, 0) - value(0, 0)) * u.x() > 0);
        CHECK(std::abs(value(0, height - 1) - value(0, 0)) <= 1 + 255 * std::abs(v.x()));
    }
}

SCENARIO("A place outside the image has no slices", "[review]") {
    const Image image = ramp();
    PageSlices slices(image);
    CHECK(slices.add("1", Vec3(500, 500, 500), 4.0).empty());
    CHECK(slices.blobs().empty());
}
