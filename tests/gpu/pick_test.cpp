#include "gpu/render/pick.h"

#include <cmath>

#include <catch2/catch.hpp>
#include <epoxy/gl.h>

#include "tests/gpu/render_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr int kSide = 300;
const Vec3 kCentre(100.0, -250.0, 40.0);

SceneView view_of_sphere(bool perspective) {
    SceneView view;
    view.camera = {.centre = kCentre,
                   .view = Vec3(0.3, 1.0, -0.2),
                   .half_height = 10.0,
                   .perspective = perspective};
    view.rectangle = {0, 0, kSide, kSide};
    return view;
}

Vec3 centroid(const Surface& surface, TriangleId t) {
    Vec3 sum = Vec3::Zero();
    for (const VertexId v : surface.triangles()[t]) sum += surface.points()[v];
    return sum / 3.0;
}

struct Pixel {
    int x = 0, y = 0;
};

Pixel pixel_at(const SceneView& view, const Vec3& point) {
    const Vec3 seen = project(view.camera, view.rectangle.aspect(), point).value();
    return {static_cast<int>(std::floor(0.5 * (seen.x() + 1.0) * kSide)),
            static_cast<int>(std::floor(0.5 * (seen.y() + 1.0) * kSide))};
}

}  // namespace

SCENARIO("The triangle whose centroid is pointed at is picked", "[gpu][render][pick]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const Surface sphere = icosphere(8.0, 2, kCentre);
    SurfaceLayer layer = layer_of(sphere);
    layer.id = 7;
    const Layers layers{.surfaces = {layer}};
    const SceneView view = view_of_sphere(GENERATE(false, true));
    Picker picker(test->renderer);
    int tried = 0;
    for (TriangleId t = 0; t < sphere.triangle_count(); ++t) {
        const Vec3 middle = centroid(sphere, t);
        if ((middle - kCentre).normalized().dot(view.camera.view.normalized()) > -0.6) continue;
        const auto [x, y] = pixel_at(view, middle);
        const Picked picked = picker.pick(view, layers, x, y, 0);
        CHECK(picked.layer == 7);
        CHECK(picked.element == t);
        CHECK((picked.point - middle).norm() < 0.08);  // a pixel is 0.07 mm
        ++tried;
    }
    CHECK(tried > 20);
    THEN("nothing is picked beside it, outside the view, and of layers without an id") {
        CHECK(picker.pick(view, layers, 5, 5).layer == 0);
        CHECK(picker.pick(view, layers, -50, 5).layer == 0);
        layer.id = 0;
        CHECK(picker.pick(view, {.surfaces = {layer}}, kSide / 2, kSide / 2).layer == 0);
    }
    THEN("a clip plane uncovers the far side") {
        SceneView clipped = view;
        clipped.clip = ClipPlane{kCentre, -view.camera.view};
        const Picked far = picker.pick(clipped, layers, kSide / 2, kSide / 2);
        CHECK((far.point - (kCentre + 8.0 * view.camera.view.normalized())).norm() < 0.2);
    }
}

SCENARIO("A pick is answered later, once, and keeps the bound framebuffer", "[gpu][render][pick]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SurfaceLayer layer = layer_of(icosphere(8.0, 3, kCentre));
    layer.id = 3;
    const SceneView view = view_of_sphere(false);
    const Layers layers{.surfaces = {layer}};
    Picker picker(test->renderer);
    CHECK_FALSE(picker.pending());
    CHECK_FALSE(picker.result().has_value());
    test->target.bind();
    picker.request(view, layers, kSide / 2, kSide / 2);
    CHECK(picker.pending());
    test->renderer.draw(view, layers);
    const Picture picture = test->target.picture();
    CHECK(covered_pixels(picture) > 1000.0);
    std::optional<Picked> picked;
    for (int i = 0; i < 100000 && !picked; ++i) picked = picker.result();
    REQUIRE(picked.has_value());
    CHECK(picked->layer == 3);
    CHECK_FALSE(picker.pending());
    CHECK_FALSE(picker.result().has_value());
}

SCENARIO("Marks and lines near the cursor win over surfaces", "[gpu][render][pick]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SurfaceLayer surface = layer_of(icosphere(8.0, 3, kCentre));
    surface.id = 1;
    const SceneView view = view_of_sphere(false);
    const Vec3 front = kCentre - 8.05 * view.camera.view.normalized();
    const std::vector<Polyline> line = {
        {.points = {front - Vec3(0, 0, 4), front, front + Vec3(0, 0, 4)}}};
    const std::vector<PointMark> marks = {{.place = kCentre + Vec3(0, 0, 20)}, {.place = front}};
    const Layers layers{
        .surfaces = {surface},
        .lines = {{.lines = std::make_shared<DrawnLines>(line), .id = 2, .hidden_opacity = 0.3}},
        .points = {{.points = std::make_shared<DrawnPoints>(marks), .id = 3}}};
    Picker picker(test->renderer);
    const Pixel middle = pixel_at(view, front);
    const Picked mark = picker.pick(view, layers, middle.x, middle.y, 0);
    CHECK(mark.layer == 3);
    CHECK(mark.element == 1);
    const Pixel above = pixel_at(view, front + Vec3(0, 0, 2));
    const Picked near_line = picker.pick(view, layers, above.x + 3, above.y, 4);
    CHECK(near_line.layer == 2);
    CHECK(near_line.element == 1);
    CHECK(picker.pick(view, layers, middle.x + 40, middle.y).layer == 1);
}

SCENARIO("A search on a lost device ends without a result", "[gpu][render][pick]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const Layers layers{.surfaces = {layer_of(icosphere(8.0, 2, kCentre))}};
    Picker picker(test->renderer);
    const auto before = epoxy_glClientWaitSync;
    epoxy_glClientWaitSync = [](GLsync, GLbitfield, GLuint64) -> GLenum { return GL_WAIT_FAILED; };
    picker.request(view_of_sphere(false), layers, kSide / 2, kSide / 2);
    const auto asked = picker.result();
    const Picked waited = picker.pick(view_of_sphere(false), layers, kSide / 2, kSide / 2);
    epoxy_glClientWaitSync = before;
    REQUIRE(asked);
    CHECK(asked->layer == 0);
    CHECK(waited.layer == 0);
    CHECK_FALSE(picker.pending());
}
