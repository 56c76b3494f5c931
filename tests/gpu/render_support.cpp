#include "tests/gpu/render_support.h"

#include <algorithm>
#include <cstdlib>

#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "tests/support/skip.h"

namespace vesselbench::test {

namespace {

std::size_t place(const Picture& picture, int x, int y) {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(x));
}

template <class Counts>
double count(const Picture& picture, const Counts& counts) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sum += counts(pixel(picture, x, y)) ? 1.0 : 0.0;
    return sum;
}

}  // namespace

ErrorCheck::ErrorCheck() : output_([this](const std::string& text) { errors_.push_back(text); }) {}

ErrorCheck::~ErrorCheck() {
    for (const std::string& error : errors_) UNSCOPED_INFO(error);
    CHECK(errors_.empty());
    CHECK(glGetError() == GL_NO_ERROR);
}

Picture RenderTest::picture(SceneView view, const Layers& layers) {
    view.rectangle = target.rectangle();
    target.bind();
    renderer.draw(view, layers);
    return target.picture();
}

std::unique_ptr<RenderTest> render_test(int side) {
    try {
        return std::make_unique<RenderTest>(side);
    } catch (const GpuUnavailable& error) {
        skip(error.what());
        return nullptr;
    }
}

std::shared_ptr<DrawnSurface> drawn(const Surface& surface) {
    return std::make_shared<DrawnSurface>(prepare_drawing(surface));
}

SurfaceLayer layer_of(const Surface& surface) {
    SurfaceLayer layer;
    layer.source = drawn(surface);
    return layer;
}

std::array<int, 3> pixel(const Picture& picture, int x, int y) {
    const std::size_t at = place(picture, x, y);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

double covered_pixels(const Picture& picture) {
    return count(picture, [](const auto& p) { return p != std::array<int, 3>{255, 255, 255}; });
}

double pixels_of(const Picture& picture, const Colour& colour) {
    const PixelColour wanted = pixel_colour(colour);
    return count(picture, [&](const auto& p) {
        return std::abs(p[0] - wanted[0]) <= 3 && std::abs(p[1] - wanted[1]) <= 3 &&
               std::abs(p[2] - wanted[2]) <= 3;
    });
}

double brightness(const Picture& picture) {
    double sum = 0.0;
    for (const std::uint8_t part : picture.rgb) sum += part;
    return sum / static_cast<double>(picture.rgb.size());
}

int largest_difference(const Picture& a, const Picture& b) {
    REQUIRE(a.rgb.size() == b.rgb.size());
    int largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
    return largest;
}

}  // namespace vesselbench::test
