#include "workbench/review/viewer_page.h"

#include <algorithm>
#include <limits>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/review/review_page_bytes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

/// Whether the build has the page; a skipped test is counted.
bool has_page() {
    if (!viewer_page_bytes().empty()) return true;
    skip("the build has no page: it was built without npm");
    return false;
}

Json case_in(const std::string& page) {
    const std::string begin = R"(<script type="application/json" id="case">)";
    const std::size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

Surface moved(const Surface& surface, const Vec3& by) {
    Positions points = surface.points();
    for (Vec3& p : points) p += by;
    return surface.with_positions(std::move(points));
}

Scene tube_with_neighbours() {
    return {.surface = fine_tube(3.0, 12.0, 24),
            .neighbours = {{"tumour", moved(icosphere(2.0, 3), {9, 0, 6})},
                           {"vein", moved(icosphere(1.0, 3), {-6, 0, 6})}}};
}

ShownMeasure heights(const Surface& surface) {
    ShownMeasure measure{
        .name = "height", .label = "Height", .unit = "mm", .values = {}, .scale = {}};
    for (const Vec3& p : surface.points()) measure.values.push_back(p.z());
    measure.scale = {.map = ColourMap::Ordered, .least = 2.0, .most = 10.0};
    return measure;
}

Surface together(const Surface& one, const Surface& other) {
    Positions points = one.points();
    points.insert(points.end(), other.points().begin(), other.points().end());
    std::vector<Triangle> triangles(one.triangles().begin(), one.triangles().end());
    const auto first = static_cast<VertexId>(one.vertex_count());
    for (const Triangle& t : other.triangles())
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace

SCENARIO("The page of a model has the vessel, its neighbours and their distances",
         "[review][viewer]") {
    if (!has_page()) return;
    const std::string page =
        viewer_page(tube_with_neighbours(), {.title = "A case", .text = "Look."});
    const Json shown = case_in(page);
    CHECK(shown["format"] == "vesselbench-viewer");
    CHECK(shown["title"] == "A case");
    CHECK(shown["text"] == "Look.");
    CHECK(shown["holds"] == Json{"surface", "neighbours"});
    REQUIRE(shown["structures"].size() == 3);
    CHECK(shown["structures"][0]["kind"] == "vessel");
    CHECK(shown["structures"][1]["name"] == "tumour");
    CHECK(shown["structures"][2]["kind"] == "neighbour");
    const std::size_t state = shown["structures"][0]["state"];
    CHECK(shown["states"][state]["patches"].size() == 3);
    REQUIRE(shown["distances"].size() == 3);
    CHECK(shown["distances"][0]["between"] == Json{0, 1});
    CHECK(shown["distances"][0]["mm"].get<double>() == Approx(4.0).epsilon(0.02));
    CHECK(shown["distances"][1]["between"] == Json{0, 2});
    CHECK(shown["distances"][1]["mm"].get<double>() == Approx(2.0).epsilon(0.02));
    CHECK(page.find("id=\"blob-chunk-0\"") != std::string::npos);
    CHECK_FALSE(shown.contains("colour"));
    CHECK_FALSE(shown.contains("slices"));
    CHECK_FALSE(shown.contains("provenance"));
}

SCENARIO("The page of a model has a chosen measure with its range and colours",
         "[review][viewer]") {
    if (!has_page()) return;
    const Scene scene = tube_with_neighbours();
    ViewerContents contents{.colour = heights(*scene.surface)};
    const Json shown = case_in(viewer_page(scene, contents));
    const Json& colour = shown["colour"];
    CHECK(colour["label"] == "Height");
    CHECK(colour["unit"] == "mm");
    CHECK(colour["least"] == 2.0);
    CHECK(colour["most"] == 10.0);
    CHECK(colour["colours"].size() > 8);
    REQUIRE(colour["values"].size() == 1);  // neighbours have none
    CHECK(colour["values"][0]["max"].get<double>() == Approx(1.0));
    THEN("it needs a value for each vertex, which may be none") {
        contents.colour->values[0] = std::numeric_limits<double>::quiet_NaN();
        CHECK_NOTHROW(viewer_page(scene, contents));
        contents.colour->values.pop_back();
        CHECK_THROWS_AS(viewer_page(scene, contents), InvalidInput);
    }
}

SCENARIO("Components of a surface are structures of their own, the largest first",
         "[review][viewer]") {
    if (!has_page()) return;
    const Surface small = icosphere(1.0, 2), large = moved(icosphere(3.0, 3), {9, 0, 0});
    const Scene scene{.surface = together(small, large)};
    const Json shown = case_in(viewer_page(scene, {.colour = heights(*scene.surface)}));
    REQUIRE(shown["structures"].size() == 2);
    CHECK(shown["structures"][0]["name"] == "vessel 1");
    CHECK(shown["colour"]["values"].size() == 2);
    REQUIRE(shown["distances"].size() == 1);
    CHECK(shown["distances"][0]["from"][0].get<double>() == Approx(6.0).epsilon(0.02));
    CHECK(shown["distances"][0]["mm"].get<double>() == Approx(5.0).epsilon(0.03));
    THEN("debris is no structure") {
        Surface debris = small;
        for (int k = 1; k < 12; ++k) debris = together(debris, moved(small, {3.0 * k, 0, 0}));
        CHECK(case_in(viewer_page({.surface = debris}, {}))["structures"].size() == 1);
    }
}

SCENARIO("The page of a model has slices of the image only where they are asked for",
         "[review][viewer]") {
    if (!has_page()) return;
    Scene scene{.surface = icosphere(5.0, 3)};
    CHECK_FALSE(case_in(viewer_page(scene, {.slices = true})).contains("slices"));
    Image image;
    image.size = {24, 24, 24};
    image.voxels = std::make_shared<const std::vector<float>>(24 * 24 * 24, 7.0F);
    scene.image = image;
    CHECK_FALSE(case_in(viewer_page(scene, {})).contains("slices"));
    const Json shown = case_in(viewer_page(scene, {.slices = true}));
    CHECK(shown["slices"].size() == 3);
    for (const double x : shown["slices_place"])
        CHECK(x == Approx(0.0).margin(1e-9));  // its middle
    CHECK(shown["holds"] == Json{"surface", "image slices"});
}

SCENARIO("Texts of a case cannot leave the data of the page that shows it", "[review][viewer]") {
    if (!has_page()) return;
    const std::string hostile = "</script><script>alert(1)</script>\xe2\x80\xa8&\"'";
    const std::string page = viewer_page(
        {.surface = icosphere(5.0, 2)}, {.title = hostile, .text = hostile, .provenance = hostile});
    CHECK(page.find("alert(1)</script>") == std::string::npos);
    CHECK(case_in(page)["provenance"] == hostile);
    CHECK(case_in(page)["title"] == hostile);
    CHECK(case_in(page)["text"] == hostile);
}

SCENARIO("The page of 100,000 triangles has at most 25 MB", "[review][viewer]") {
    if (!has_page()) return;
    const Scene scene{.surface = icosphere(20.0, 6),  // 81,920 triangles
                      .neighbours = {{"other", moved(icosphere(5.0, 5), {40, 0, 0})}}};  // 20,480
    CHECK(viewer_page(scene, {.colour = heights(*scene.surface)}).size() < 25'000'000);
}

SCENARIO("The page of a model needs a surface", "[review][viewer]") {
    if (has_page()) CHECK_THROWS_AS(viewer_page({}, {}), AlgorithmFailure);
}
