#include "meshing/products/glb.h"

#include <algorithm>
#include <cstring>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::json;

namespace {

constexpr std::size_t kJsonStart = 20;

/// A GLB file: its JSON and its buffer.
struct Glb {
    Json json;
    std::string buffer;

    [[nodiscard]] const Json& node(const std::string& name) const {
        const auto found = std::ranges::find_if(
            json["nodes"], [&](const Json& node) { return node["name"] == name; });
        REQUIRE(found != json["nodes"].end());
        return *found;
    }

    [[nodiscard]] const Json& primitive(const std::string& name) const {
        return json["meshes"].at(node(name)["mesh"].get<std::size_t>())["primitives"].at(0);
    }

    [[nodiscard]] const Json& accessor(const Json& number) const {
        return json["accessors"].at(number.get<std::size_t>());
    }

    [[nodiscard]] const Json& material(const std::string& name) const {
        return json["materials"].at(primitive(name)["material"].get<std::size_t>());
    }

    template <class Number>
    [[nodiscard]] std::vector<Number> numbers(const Json& accessor) const {
        const Json& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
        std::vector<Number> read(view["byteLength"].get<std::size_t>() / sizeof(Number));
        std::memcpy(read.data(), buffer.data() + view["byteOffset"].get<std::size_t>(),
                    read.size() * sizeof(Number));
        return read;
    }
};

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + place, 4);
    return value;
}

/// Writes a model and reads it by the glTF 2.0 specification, section 4.4.
Glb written(const GlbModel& model) {
    const std::string path = temporary_folder() + "/model.glb";
    write_glb(model, path);
    const std::string bytes = file_content(path);
    REQUIRE(bytes.starts_with("glTF"));
    REQUIRE(number_at(bytes, 4) == 2);
    REQUIRE(number_at(bytes, 8) == bytes.size());
    const std::uint32_t size = number_at(bytes, 12);
    REQUIRE(size % 4 == 0);
    REQUIRE(number_at(bytes, kJsonStart + size) == bytes.size() - 28 - size);
    return {Json::parse(bytes.substr(kJsonStart, size)), bytes.substr(kJsonStart + size + 8)};
}

Surface moved(const Surface& surface, const Vec3& by) {
    Positions points = surface.points();
    for (Vec3& p : points) p += by;
    return surface.with_positions(std::move(points));
}

/// A tube between two balls.
GlbModel tube_with_neighbours() {
    return {.surface = fine_tube(3.0, 12.0, 12),
            .neighbours = {{"tumour", moved(icosphere(2.0, 2), {9, 0, 3})},
                           {"optic_nerve", moved(icosphere(1.0, 2), {-7, 0, 3})}},
            .colours = {}};
}

/// Red at the first vertex to black at the last one.
GlbColours reds(std::size_t count) {
    GlbColours colours{.name = "local-radius",
                       .label = "Local radius",
                       .unit = "mm",
                       .least = 1.5,
                       .most = 4.0,
                       .map = {{0, 0, 0}, {255, 0, 0}},
                       .vertices = {}};
    for (std::size_t v = 0; v < count; ++v)
        colours.vertices.push_back(
            {1.0F - static_cast<float>(v) / static_cast<float>(count), 0, 0});
    return colours;
}

}  // namespace

SCENARIO("A GLB file has a named node for each part of the model", "[meshing][glb]") {
    const Glb glb = written(tube_with_neighbours());
    const auto children = [&](const std::string& name) {
        std::set<std::string> names;
        for (const Json& child : glb.node(name)["children"])
            names.insert(glb.json["nodes"].at(child.get<std::size_t>())["name"]);
        return names;
    };
    CHECK(glb.json["scenes"][0]["nodes"] == Json{0});
    CHECK(children("model") == std::set<std::string>{"vessel", "neighbours"});
    CHECK(children("vessel") == std::set<std::string>{"wall", "inlet", "outlet_1"});
    CHECK(children("neighbours") == std::set<std::string>{"optic_nerve", "tumour"});
    THEN("neighbours are seen through, each in a colour of its own; the vessel is not") {
        CHECK(glb.material("tumour")["alphaMode"] == "BLEND");
        CHECK(glb.material("tumour")["pbrMetallicRoughness"]["baseColorFactor"] !=
              glb.material("optic_nerve")["pbrMetallicRoughness"]["baseColorFactor"]);
        CHECK_FALSE(glb.material("wall").contains("alphaMode"));
    }
    THEN("without neighbours there is no group of them") {
        const Glb alone =
            written({.surface = fine_tube(3.0, 12.0, 12), .neighbours = {}, .colours = {}});
        CHECK(alone.json["nodes"].size() == 5);
    }
}

SCENARIO("A GLB file's accessors lie in its buffer, and its corners among its vertices",
         "[meshing][glb]") {
    GlbModel model = tube_with_neighbours();
    model.colours = reds(model.surface.vertex_count());
    const Glb glb = written(model);
    CHECK(glb.json["buffers"][0]["byteLength"] == glb.buffer.size());
    for (const Json& view : glb.json["bufferViews"]) {
        CHECK(view["byteOffset"].get<std::size_t>() % 4 == 0);
        CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <=
              glb.buffer.size());
    }
    std::size_t triangles = 0;
    for (const Json& mesh : glb.json["meshes"])
        for (const Json& primitive : mesh["primitives"]) {
            const std::size_t vertices = glb.accessor(primitive["attributes"]["POSITION"])["count"];
            for (const auto& [name, number] : primitive["attributes"].items())
                CHECK(glb.accessor(number)["count"] == vertices);
            const auto corners = glb.numbers<std::uint32_t>(glb.accessor(primitive["indices"]));
            CHECK(glb.accessor(primitive["indices"])["count"] == corners.size());
            CHECK(std::ranges::max(corners) < vertices);
            triangles += corners.size() / 3;
        }
    std::size_t expected = model.surface.triangle_count();
    for (const auto& [name, neighbour] : model.neighbours) expected += neighbour.triangle_count();
    CHECK(triangles == expected);
}

SCENARIO("A GLB file has its positions in millimetres below a node that makes metres of them",
         "[meshing][glb]") {
    const GlbModel model = tube_with_neighbours();
    const Glb glb = written(model);
    CHECK(glb.node("model")["scale"] == Json{1e-3, 1e-3, 1e-3});
    const Json centre = glb.node("model")["extras"]["centre_mm"];
    for (const auto& [name, surface] : model.neighbours) {
        const Json& accessor = glb.accessor(glb.primitive(name)["attributes"]["POSITION"]);
        const auto floats = glb.numbers<float>(accessor);
        const Bounds box = bounds(surface);
        for (int k = 0; k < 3; ++k) {
            const double offset = centre[static_cast<std::size_t>(k)];
            CHECK(accessor["min"][static_cast<std::size_t>(k)].get<double>() + offset ==
                  Approx(box.min[k]).margin(1e-5));
            CHECK(accessor["max"][static_cast<std::size_t>(k)].get<double>() + offset ==
                  Approx(box.max[k]).margin(1e-5));
            CHECK(floats[static_cast<std::size_t>(k)] + offset ==
                  Approx(surface.points()[0][k]).margin(1e-5));
        }
    }
}

SCENARIO("A measure colours the wall of a GLB file, which says what the colours mean",
         "[meshing][glb]") {
    GlbModel model = tube_with_neighbours();
    model.colours = reds(model.surface.vertex_count());
    const Glb glb = written(model);
    REQUIRE(glb.primitive("wall")["attributes"].contains("COLOR_0"));
    const Json& accessor = glb.accessor(glb.primitive("wall")["attributes"]["COLOR_0"]);
    CHECK(accessor["count"] == model.surface.vertex_count());
    CHECK(accessor["normalized"] == true);
    const auto shares = glb.numbers<std::uint16_t>(accessor);
    CHECK(shares[0] == 65535);
    CHECK(shares[1] == 0);
    CHECK(shares[3] == 65535);
    CHECK(shares[4] < 65535);
    CHECK(glb.material("wall")["pbrMetallicRoughness"]["baseColorFactor"] ==
          Json{1.0, 1.0, 1.0, 1.0});
    CHECK_FALSE(glb.primitive("inlet")["attributes"].contains("COLOR_0"));
    CHECK_FALSE(glb.primitive("tumour")["attributes"].contains("COLOR_0"));
    const Json& legend = glb.node("wall")["extras"];
    CHECK(legend["label"] == "Local radius");
    CHECK(legend["unit"] == "mm");
    CHECK(legend["least"] == 1.5);
    CHECK(legend["most"] == 4.0);
    CHECK(legend["colours"] == Json{{0, 0, 0}, {255, 0, 0}});
    CHECK_FALSE(written(tube_with_neighbours()).node("wall").contains("extras"));
}

SCENARIO("A GLB file needs triangles, and a colour for each vertex", "[meshing][glb]") {
    const std::string path = temporary_folder() + "/model.glb";
    GlbModel model = tube_with_neighbours();
    model.colours = reds(3);
    CHECK_THROWS_AS(write_glb(model, path), InvalidInput);
    CHECK_THROWS_AS(
        write_glb({.surface = make_surface({}, {}), .neighbours = {}, .colours = {}}, path),
        InvalidInput);
    model.colours.reset();
    model.neighbours["nothing"] = make_surface({}, {});
    CHECK(written(model).json["meshes"].size() == 5);
}
