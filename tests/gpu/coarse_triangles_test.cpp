#include "gpu/render/coarse_triangles.h"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "gpu/render/drawn_surface.h"
#include "tests/gpu/render_support.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("A surface is drawn from far fewer of its own vertices while it turns",
         "[gpu][render][arrays]") {
    const Surface surface = GENERATE(icosphere(5.0, 5), closed_tube(2.0, 20.0, 60, 80));
    const DrawingArrays drawing = prepare_drawing(surface);
    const std::vector<Triangle> coarse = coarse_triangles(*drawing.layout);
    CHECK(coarse.size() < surface.triangle_count() / 3);
    CHECK(coarse.size() > surface.triangle_count() / 20);
    THEN("corners are drawn vertices of one patch, and no triangle is degenerate") {
        bool one_patch = true, proper = true;
        for (const Triangle& t : coarse) {
            std::set<VertexId> corners;
            for (const VertexId drawn : t) {
                corners.insert(original_of(drawing, drawn));
                one_patch =
                    one_patch && drawing.layout->tags[drawn] / 4 == drawing.layout->tags[t[0]] / 4;
            }
            proper = proper && corners.size() == 3;
        }
        CHECK(one_patch);
        CHECK(proper);
    }
}

SCENARIO("Opposite walls of a thin vessel stay apart in few triangles", "[gpu][render][arrays]") {
    // Six vertices around: a grid as coarse as its triangles are long would flatten it.
    const DrawingArrays drawing = prepare_drawing(open_tube(0.2, 20.0, 6, 60));
    const std::vector<Triangle> coarse = coarse_triangles(*drawing.layout);
    for (double z = 1.0; z < 19.0; z += 1.0) {
        double least = 1.0, most = -1.0;
        for (const Triangle& t : coarse)
            for (const VertexId drawn : t)
                if (std::abs(drawing.surface.points()[original_of(drawing, drawn)].z() - z) < 1.0) {
                    const double x = drawing.surface.points()[original_of(drawing, drawn)].x();
                    least = std::min(least, x);
                    most = std::max(most, x);
                }
        CHECK(most - least > 0.25);
    }
}

SCENARIO("A coarse picture has the outline of the full one", "[gpu][render]") {
    constexpr int kSide = 240;
    const auto test = render_test(kSide);
    if (!test) return;
    Layers layers{.surfaces = {layer_of(icosphere(8.0, 7))}};
    const SceneView view{.camera = {.centre = Vec3::Zero(), .half_height = 10.0}};
    const Picture full = test->picture(view, layers);
    layers.surfaces[0].detail = Detail::Coarse;
    REQUIRE(layers.surfaces[0].source->bind_triangles(Detail::Coarse) <
            layers.surfaces[0].source->triangle_count() / 3);
    const Picture coarse = test->picture(view, layers);
    CHECK(covered_pixels(coarse) == Approx(covered_pixels(full)).epsilon(0.002));
    THEN("its colours differ little") {
        for (const int x : {60, 100, 120, 160})
            for (std::size_t channel = 0; channel < 3; ++channel)
                CHECK(std::abs(pixel(coarse, x, 120)[channel] - pixel(full, x, 120)[channel]) <= 6);
    }
}
