#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/context.h"
#include "gpu/debug_output.h"
#include "gpu/render/drawn_surface.h"
#include "gpu/render/renderer.h"
#include "gpu/render/target.h"

namespace vesselbench::test {

/// Collects what the driver reports while it exists; its end checks that there was no error.
class ErrorCheck {
public:
    ErrorCheck();
    ~ErrorCheck();
    ErrorCheck(const ErrorCheck&) = delete;
    ErrorCheck& operator=(const ErrorCheck&) = delete;

private:
    std::vector<std::string> errors_;
    DebugOutput output_;
};

/// A context, a renderer and a square target for the length of a test.
struct RenderTest {
    OffscreenContext context{Sharing::None, true};
    ErrorCheck errors;
    Renderer renderer;
    RenderTarget target;

    explicit RenderTest(int side) : target(side, side) {}

    /// The layers in a view of the whole target on white.
    [[nodiscard]] Picture picture(SceneView view, const Layers& layers);
};

/// Nothing where there is no usable OpenGL: the scenario counts as skipped.
[[nodiscard]] std::unique_ptr<RenderTest> render_test(int side);

[[nodiscard]] std::shared_ptr<DrawnSurface> drawn(const Surface& surface);

/// A layer of an uploaded surface.
[[nodiscard]] SurfaceLayer layer_of(const Surface& surface);

[[nodiscard]] std::array<int, 3> pixel(const Picture& picture, int x, int y);

/// Pixels that are not white.
[[nodiscard]] double covered_pixels(const Picture& picture);

/// Pixels within a few steps of a colour.
[[nodiscard]] double pixels_of(const Picture& picture, const Colour& colour);

/// Mean of all numbers of a picture, 0 to 255.
[[nodiscard]] double brightness(const Picture& picture);

/// Largest difference of two pictures' numbers.
[[nodiscard]] int largest_difference(const Picture& a, const Picture& b);

}  // namespace vesselbench::test
