#include "gpu/render/renderer.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "gpu/device_surface.h"
#include "gpu/gpu_meter.h"
#include "gpu/render/drawn_device_surface.h"
#include "tests/gpu/render_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr int kSide = 240;
constexpr double kPi = std::numbers::pi;
const Vec3 kCentre(100.0, -250.0, 40.0);
const Colour kSection(0.2F, 0.5F, 0.9F);

/// Looks at the test shapes' centre; 20 mm high.
SceneView view_on(const Vec3& centre, bool perspective = false) {
    SceneView view;
    view.camera = {.centre = centre, .half_height = 10.0, .perspective = perspective};
    return view;
}

/// Pixels of an area [mm^2] in view_on.
double pixels(double area) {
    return area * (kSide / 20.0) * (kSide / 20.0);
}

SurfaceLayer coloured(const Surface& surface, const Colour& colour) {
    SurfaceLayer layer = layer_of(surface);
    layer.base = colour;
    return layer;
}

double part(const Picture& picture, int x, int y, std::size_t channel) {
    return pixel(picture, x, y)[channel];
}

}  // namespace

SCENARIO("A sphere covers the pixels of its outline", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const Layers layers{.surfaces = {layer_of(icosphere(8.0, 5, kCentre))}};
    CHECK(covered_pixels(test->picture(view_on(kCentre), layers)) ==
          Approx(pixels(kPi * 64.0)).epsilon(0.02));
    THEN("in perspective, those of its tangent cone") {
        const SceneView view = view_on(kCentre, true);
        const double distance = eye_distance(view.camera);
        const double radius = 8.0 * distance / std::sqrt(distance * distance - 64.0);
        CHECK(covered_pixels(test->picture(view, layers)) ==
              Approx(pixels(kPi * radius * radius)).epsilon(0.02));
    }
    THEN("a part of the target is drawn alone") {
        SceneView view = view_on(kCentre);
        static_cast<void>(test->picture(view, {}));
        view.rectangle = {kSide / 2, 0, kSide / 2, kSide / 2};
        view.background.reset();
        test->target.bind();
        test->renderer.draw(view, layers);
        const Picture picture = test->target.picture();
        CHECK(covered_pixels(picture) == Approx(pixels(kPi * 64.0) / 4.0).epsilon(0.03));
        CHECK(part(picture, kSide / 4, kSide / 2, 0) == 255);
    }
}

SCENARIO("What is behind a transparent surface shows through", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SurfaceLayer outer = coloured(icosphere(8.0, 4, kCentre), {0.7F, 0.1F, 0.1F});
    SurfaceLayer inner = coloured(icosphere(3.0, 4, kCentre), {0.05F, 0.05F, 0.9F});
    const auto blue_in_the_middle = [&](double opacity) {
        outer.opacity = opacity;
        return part(test->picture(view_on(kCentre), {.surfaces = {outer, inner}}), kSide / 2,
                    kSide / 2, 2);
    };
    const double hidden = blue_in_the_middle(1.0), veiled = blue_in_the_middle(0.5),
                 clear = blue_in_the_middle(0.05);
    CHECK(veiled > hidden + 20.0);
    CHECK(clear > veiled + 20.0);
}

SCENARIO("A clip plane removes its side, and the section is filled", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SurfaceLayer layer = layer_of(icosphere(8.0, 5, kCentre));
    SceneView view = view_on(kCentre, GENERATE(false, true));
    const double whole = covered_pixels(test->picture(view, {.surfaces = {layer}}));
    view.clip = ClipPlane{kCentre, Vec3(1, 0, 0)};
    const Picture half = test->picture(view, {.surfaces = {layer}});
    CHECK(covered_pixels(half) == Approx(0.5 * whole).epsilon(0.02));
    CHECK(part(half, kSide / 2 + 20, kSide / 2, 0) == 255);
    WHEN("the plane faces the eye at 3 mm before the centre") {
        layer.section = kSection;
        view.clip = ClipPlane{kCentre - Vec3(0, 3, 0), Vec3(0, -1, 0)};
        const double scale = view.camera.perspective
                                 ? eye_distance(view.camera) / (eye_distance(view.camera) - 3.0)
                                 : 1.0;
        const double area = pixels(kPi * (64.0 - 9.0) * scale * scale);
        CHECK(pixels_of(test->picture(view, {.surfaces = {layer}}), kSection) ==
              Approx(area).epsilon(0.02));
        THEN("an oblique section covers its projection") {
            view.camera.perspective = false;
            const Vec3 normal = Vec3(0.5, -0.8, 0.2).normalized();
            view.clip = ClipPlane{kCentre, normal};
            CHECK(pixels_of(test->picture(view, {.surfaces = {layer}}), kSection) ==
                  Approx(pixels(kPi * 64.0) * -normal.y()).epsilon(0.02));
        }
        THEN("a hollow sphere shows a ring") {
            Layers shell{.surfaces = {layer}};
            shell.surfaces.front().source = drawn(
                mapped(sphere_shell(8.0, 2.0, 5), [](const Vec3& p) { return Vec3(p + kCentre); }));
            CHECK(pixels_of(test->picture(view, shell), kSection) ==
                  Approx(area * (64.0 - 36.0) / (64.0 - 9.0)).epsilon(0.03));
        }
        THEN("a layer that is not clipped stays whole") {
            layer.clipped = false;
            const Picture picture = test->picture(view, {.surfaces = {layer}});
            CHECK(pixels_of(picture, kSection) == 0.0);
            CHECK(covered_pixels(picture) == whole);
        }
    }
}

SCENARIO("Edges darken the surface", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SurfaceLayer layer = layer_of(icosphere(8.0, 3, kCentre));
    const auto shown = [&](Edges edges) {
        layer.edges = edges;
        return test->picture(view_on(kCentre), {.surfaces = {layer}});
    };
    const Picture plain = shown(Edges::Off), over = shown(Edges::Over), only = shown(Edges::Only);
    CHECK(brightness(over) < brightness(plain) - 4.0);
    CHECK(brightness(only) > brightness(plain) + 10.0);
    CHECK(covered_pixels(over) == Approx(covered_pixels(plain)).epsilon(0.001));
    THEN("as much as lines do, which other sources draw") {
        const Device device = current_device();
        const auto uploaded =
            std::make_shared<const DeviceSurface>(device, icosphere(8.0, 3, kCentre));
        GpuMeter meter(uploaded);
        meter.measure_shape(uploaded->shifts());
        const auto source = std::make_shared<DrawnDeviceSurface>(uploaded);
        source->show({&uploaded->shifts(), &meter.normals(), nullptr});
        layer.source = source;
        CHECK(brightness(shown(Edges::Over)) == Approx(brightness(over)).margin(4.0));
        CHECK(brightness(shown(Edges::Only)) > brightness(plain) + 10.0);
        CHECK(largest_difference(shown(Edges::Off), plain) < 12);
    }
}

SCENARIO("Colours show patches, values and vertices", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const Surface sphere = icosphere(8.0, 4, kCentre);
    const auto source = drawn(sphere);
    SurfaceLayer layer;
    layer.source = source;
    const auto middle = [&] {
        const Picture picture = test->picture(view_on(kCentre), {.surfaces = {layer}});
        return pixel(picture, kSide / 2, kSide / 2);
    };
    layer.colouring = Colouring::Patches;
    layer.patch_colours = {Colour(0.0F, 0.6F, 0.0F)};
    CHECK(middle()[1] > middle()[0] + 80);
    layer.colouring = Colouring::Values;
    layer.map = ColourMap::Diverging;
    layer.least = -1.0;
    std::vector<double> values(sphere.vertex_count(), 1.0);
    source->set_values(values);
    CHECK(middle()[0] > middle()[2] + 80);
    values.assign(values.size(), -1.0);
    std::vector<VertexId> all(values.size());
    for (VertexId v = 0; v < all.size(); ++v) all[v] = v;
    source->set_values(values, all);
    CHECK(middle()[2] > middle()[0] + 80);
    values.assign(values.size(), std::numeric_limits<double>::quiet_NaN());
    source->set_values(values);
    CHECK(std::abs(middle()[2] - middle()[0]) < 12);
    layer.colouring = Colouring::Vertices;
    source->set_colours(std::vector<Colour>(values.size(), Colour(0.6F, 0.0F, 0.6F)));
    CHECK(middle()[0] > middle()[1] + 80);
}

SCENARIO("Moving a few vertices draws what a full upload draws", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const Surface sphere = icosphere(8.0, 5, kCentre);
    Positions points = sphere.points();
    std::vector<VertexId> moved;
    for (VertexId v = 0; v < points.size(); ++v)
        if (points[v].y() < kCentre.y() - 6.5) {
            points[v].y() += 1.5;
            moved.push_back(v);
        }
    const auto source = drawn(sphere);
    SurfaceLayer layer;
    layer.source = source;
    const Picture before = test->picture(view_on(kCentre), {.surfaces = {layer}});
    source->move(points, moved);
    const Picture after = test->picture(view_on(kCentre), {.surfaces = {layer}});
    CHECK(largest_difference(before, after) > 20);
    const Layers whole{.surfaces = {layer_of(sphere.with_positions(points))}};
    CHECK(largest_difference(after, test->picture(view_on(kCentre), whole)) <= 3);
}

SCENARIO("Lines, marks and slices are as large as stated", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const SceneView view = view_on(kCentre);
    THEN("a line of 10 mm covers its length times its width") {
        const Polyline line{.points = {kCentre - Vec3(5, 0, 3), kCentre + Vec3(5, 0, -3)}};
        const LinesLayer layer{.lines = std::make_shared<DrawnLines>(std::span(&line, 1)),
                               .width = 6.0};
        const double length = 10.0 * kSide / 20.0;
        CHECK(covered_pixels(test->picture(view, {.lines = {layer}})) ==
              Approx(length * 6.0 + kPi * 9.0).epsilon(0.06));
    }
    THEN("a mark covers its disc, also behind a surface, where it is paler") {
        const PointMark mark{.place = kCentre, .colour = {0.0F, 0.0F, 0.8F}, .diameter = 40.0};
        const PointsLayer layer{.points = std::make_shared<DrawnPoints>(std::span(&mark, 1))};
        CHECK(covered_pixels(test->picture(view, {.points = {layer}})) ==
              Approx(kPi * 400.0).epsilon(0.06));
        const SurfaceLayer sphere = layer_of(icosphere(8.0, 4, kCentre));
        const auto blue = [&](const Layers& layers) {
            return part(test->picture(view, layers), kSide / 2, kSide / 2, 2);
        };
        const double paler = blue({.surfaces = {sphere}, .points = {layer}});
        CHECK(paler > blue({.surfaces = {sphere}}) + 10.0);
        CHECK(paler < blue({.points = {layer}}) - 10.0);
    }
    THEN("a slice shows its scalars by window and level") {
        const std::vector<float> values = {0.0F, 100.0F, 200.0F, 300.0F};
        const SliceScalars scalars{.corner = kCentre + Vec3(-5, 0, 5),
                                   .across = Vec3(10, 0, 0),
                                   .down = Vec3(0, 0, -10),
                                   .columns = 2,
                                   .rows = 2,
                                   .values = values};
        const SliceLayer layer{.slice = std::make_shared<DrawnSlice>(scalars),
                               .window = 400.0,
                               .level = 200.0,
                               .smooth = false};
        const Picture picture = test->picture(view, {.slices = {layer}});
        CHECK(part(picture, kSide / 2 - 20, kSide / 2 - 20, 0) == 0);
        CHECK(part(picture, kSide / 2 + 20, kSide / 2 - 20, 0) == Approx(64).margin(1));
        CHECK(part(picture, kSide / 2 - 20, kSide / 2 + 20, 0) == Approx(128).margin(1));
        CHECK(part(picture, kSide / 2 + 20, kSide / 2 + 20, 0) == Approx(191).margin(1));
    }
}

SCENARIO("A slice has holes where it has no value or no label", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    const auto shown = [&](const std::vector<float>& values, bool labels) {
        const SliceScalars scalars{.corner = kCentre + Vec3(-5, 0, 5),
                                   .across = Vec3(10, 0, 0),
                                   .down = Vec3(0, 0, -10),
                                   .columns = 2,
                                   .rows = 2,
                                   .values = values};
        const SliceLayer layer{.slice = std::make_shared<DrawnSlice>(scalars),
                               .level = 10.0,
                               .smooth = false,
                               .labels = labels};
        return test->picture(view_on(kCentre), {.slices = {layer}});
    };
    const double quarter = pixels(25.0);
    const float none = std::numeric_limits<float>::quiet_NaN();
    CHECK(covered_pixels(shown({0.0F, none, none, none}, false)) == Approx(quarter).epsilon(0.03));
    const Picture labels = shown({0.0F, 1.0F, 2.0F, 13.0F}, true);
    CHECK(covered_pixels(labels) == Approx(3.0 * quarter).epsilon(0.03));
    CHECK(pixels_of(labels, category_colour(1)) == Approx(2.0 * quarter).epsilon(0.03));
    CHECK(pixels_of(labels, category_colour(2)) == Approx(quarter).epsilon(0.03));
}

SCENARIO("An endoscopic view shows the wall all round", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SceneView view;
    view.camera = looking_from(Vec3(0, 0, 5), Vec3(0, 0, 1), Vec3(0, 1, 0), 3.0);
    const Layers layers{.surfaces = {layer_of(closed_tube(2.0, 20.0, 48, 60))}};
    CHECK(covered_pixels(test->picture(view, layers)) == kSide * kSide);
}

SCENARIO("A background runs from one colour to another", "[gpu][render]") {
    const auto test = render_test(kSide);
    if (!test) return;
    SceneView view = view_on(kCentre);
    view.background = Background{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    const Picture picture = test->picture(view, {});
    CHECK(part(picture, 5, 2, 2) < 10);
    CHECK(part(picture, 5, kSide - 3, 2) > 245);
    CHECK(part(picture, 5, kSide / 2, 2) == Approx(128).margin(3));
}
