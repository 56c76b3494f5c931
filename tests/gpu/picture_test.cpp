#include "gpu/picture.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "gpu/png.h"
#include "gpu/transparency.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

bool white(const Picture& picture, int x, int y) {
    const auto at = static_cast<std::size_t>(3 * (y * picture.width + x));
    return picture.rgb[at] == 255 && picture.rgb[at + 1] == 255 && picture.rgb[at + 2] == 255;
}

double coverage(const Picture& picture) {
    double covered = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) covered += white(picture, x, y) ? 0.0 : 1.0;
    return covered / (picture.width * picture.height);
}

PictureOptions small() {
    PictureOptions options;
    options.width = options.height = 200;
    return options;
}

}  // namespace

SCENARIO("A picture on black and on white gives one on nothing", "[gpu][picture]") {
    // Nothing, a solid colour, and half of it.
    const Picture black{3, 1, {0, 0, 0, 200, 100, 0, 100, 50, 0}};
    const Picture white{3, 1, {255, 255, 255, 200, 100, 0, 227, 177, 127}};
    const ClearPicture clear = without_background(black, white);
    CHECK(clear.width == 3);
    REQUIRE(clear.rgba.size() == 12);
    CHECK(clear.rgba[3] == 0);
    CHECK(std::vector<int>(clear.rgba.begin() + 4, clear.rgba.begin() + 8) ==
          std::vector{200, 100, 0, 255});
    CHECK(clear.rgba[11] == 128);
    CHECK(int{clear.rgba[8]} == Approx(200).margin(2));
    CHECK_THROWS_AS(without_background(black, Picture{1, 1, {0, 0, 0}}), InvalidInput);
}

SCENARIO("A sphere is drawn as a disc in the middle", "[gpu][picture]") {
    const Picture picture = draw(icosphere(5.0, 4, Vec3(100, 50, -20)), small());
    THEN("its share of the picture is that of the inscribed circle, less the margin") {
        CHECK(coverage(picture) == Approx(0.7854 / (1.06 * 1.06)).epsilon(0.02));
    }
    THEN("the middle is coloured and the corners are white") {
        CHECK_FALSE(white(picture, 100, 100));
        CHECK(white(picture, 0, 0));
        CHECK(white(picture, 199, 199));
    }
}

SCENARIO("The same surface gives the same picture, another side another one", "[gpu][picture]") {
    const Surface tube = closed_tube(2.0, 20.0, 24, 20);
    const Picture side = draw(tube, small());
    CHECK(side.rgb == draw(tube, small()).rgb);
    PictureOptions from_above = small();
    from_above.view = Vec3(0, 0, -1);
    from_above.up = Vec3(0, 1, 0);
    CHECK(coverage(draw(tube, from_above)) > 3.0 * coverage(side));
}

SCENARIO("Undrawable input is rejected", "[gpu][picture]") {
    CHECK_THROWS_AS(draw(Surface{}, small()), InvalidInput);
    PictureOptions options = small();
    options.width = 0;
    CHECK_THROWS_AS(draw(icosphere(1.0, 1), options), InvalidInput);
    options = small();
    options.up = options.view;
    CHECK_THROWS_AS(draw(icosphere(1.0, 1), options), InvalidInput);
}

SCENARIO("A PNG file states its size and ends properly", "[gpu][picture]") {
    const std::string file = png(draw(icosphere(1.0, 1), small()));
    CHECK(file.substr(1, 3) == "PNG");
    CHECK(static_cast<unsigned char>(file[19]) == 200);
    CHECK(file.substr(file.size() - 8, 4) == "IEND");
}
