#include "workbench/project/serialization.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/session/small_operations.h"
#include "tests/support/scene_bits.h"
#include "tests/support/shapes.h"
#include "workbench/project/stored_text.h"

using namespace vesselbench;

namespace {

/// A scene that has everything.
Scene full_scene() {
    Scene scene;
    scene.surface = test::icosphere(10.0, 2);
    Progress quiet;
    scene = test::find_test_operation("flatten").run(scene, {}, quiet).scene;
    Image image;
    image.size = {2, 3, 4};
    image.index_to_patient(0, 3) = -7.25;
    image.voxels = std::make_shared<const std::vector<float>>(24, 0.1F);
    scene.image = scene.mask = image;
    return scene;
}

Surface moved(const Surface& surface, std::size_t count) {
    Positions points = surface.points();
    for (std::size_t i = 0; i < count; ++i) points[i * 5 % points.size()].x() += 1.0 / 3.0;
    return surface.with_positions(std::move(points));
}

bool same_parts(const Scene& a, const Scene& b) {
    return test::bits_of(a) == test::bits_of(b);
}

}  // namespace

SCENARIO("A scene survives its blob bit for bit", "[session][serialization]") {
    const Scene scene = full_scene();
    CHECK(same_parts(scene, decode_scene(encode_scene(scene))));
    CHECK(same_parts({}, decode_scene(encode_scene({}))));
    THEN("its bits do not depend on what its parts share") {
        Scene apart = scene;
        apart.mask->voxels = std::make_shared<const std::vector<float>>(24, 0.1F);
        CHECK(same_parts(scene, apart));
    }
    THEN("known parts are shared, not copied") {
        const auto known = take_apart(scene).parts;
        const Bytes blob = encode_scene(scene, known);
        CHECK(blob.size() < 2000);
        const Scene back = decode_scene(blob, known);
        CHECK(back.surface->topology == scene.surface->topology);
        CHECK(back.volume_mesh == scene.volume_mesh);
    }
}

SCENARIO("Parts survive compression, odd numbers too", "[session][serialization]") {
    Positions odd = {{-0.0, 1e-310, 1e300},
                     {std::numeric_limits<double>::infinity(), 0.1, -1.0},
                     {std::nan("7"), 2.0, 3.0}};
    const ScenePart part = std::make_shared<const Positions>(odd);
    for (const auto compression : {Compression::None, Compression::Zstd}) {
        const ScenePart back = PartDecoder(encode(part, compression)).finish();
        CHECK(content_hash(back) == content_hash(part));
    }
    const ScenePart empty = std::make_shared<const Positions>();
    CHECK(content_hash(PartDecoder(encode(empty, Compression::Zstd)).finish()) ==
          content_hash(empty));
}

SCENARIO("Moved vertices cost less than 64 bytes each", "[session][serialization]") {
    const Surface sphere = test::icosphere(10.0, 4);
    const std::size_t count = GENERATE(1, 10, 300, 1100);
    const Surface after = moved(sphere, count);
    const ScenePart old_part = sphere.positions, new_part = after.positions;
    const auto difference = encode_difference(new_part, old_part);
    REQUIRE(difference);
    CHECK(difference->size() <= 64 * count + 100);
    PartDecoder decoder(old_part);
    decoder.apply_difference(*difference);
    CHECK(content_hash(decoder.finish()) == content_hash(new_part));
    THEN("where most have moved, the whole is the better blob") {
        const ScenePart all = moved(sphere, sphere.vertex_count()).positions;
        CHECK_FALSE(encode_difference(all, old_part));
    }
}

SCENARIO("A difference bridges other lengths", "[session][serialization]") {
    const Surface small = test::icosphere(1.0, 1);
    std::vector<Triangle> triangles(small.triangles().begin(), small.triangles().end());
    triangles.push_back({0, 1, 2});
    const ScenePart longer = std::make_shared<const Topology>(triangles, small.vertex_count() + 4);
    const ScenePart shorter = small.topology;
    for (const auto& [to, from] : {std::pair(longer, shorter), std::pair(shorter, longer)}) {
        const auto difference = encode_difference(to, from);
        REQUIRE(difference);
        PartDecoder decoder(from);
        decoder.apply_difference(*difference);
        CHECK(content_hash(decoder.finish()) == content_hash(to));
    }
}

SCENARIO("A volume mesh with layers is stored whole, and one without as ever",
         "[session][serialization]") {
    VolumeMesh mesh;
    mesh.points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    mesh.tetrahedra = {{3, 4, 6, 5}};
    mesh.boundary = {{0, 1, 2}};
    mesh.boundary_patches = {0};
    mesh.patches = {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}};
    const auto blob_of = [](const VolumeMesh& any) {
        return encode(ScenePart(std::make_shared<const VolumeMesh>(any)), Compression::None);
    };
    constexpr std::size_t kVersionByte = 2, kHeader = 40;
    const Bytes before = blob_of(mesh);
    mesh.prisms = {{0, 1, 2, 3, 4, 5}};
    mesh.boundary_sides = {{0, 3, 4, 1}};
    mesh.side_patches = {1};
    const Bytes after = blob_of(mesh);
    CHECK(before[kVersionByte] == std::byte{1});
    CHECK(after[kVersionByte] == std::byte{2});
    CHECK(std::equal(before.begin() + kHeader, before.end(), after.begin() + kHeader));
    const ScenePart back = PartDecoder(after).finish();
    const VolumeMesh& read = *std::get<std::shared_ptr<const VolumeMesh>>(back);
    CHECK(read.tetrahedra == mesh.tetrahedra);
    CHECK(read.prisms == mesh.prisms);
    CHECK(read.boundary_sides == mesh.boundary_sides);
    CHECK(read.side_patches == mesh.side_patches);
    CHECK(content_hash(back) == content_hash(PartDecoder(after).finish()));
    THEN("a prism or a side of a missing point or patch is refused") {
        mesh.side_patches = {7};
        CHECK_THROWS_AS(PartDecoder(blob_of(mesh)).finish(), InvalidInput);
        mesh.side_patches = {1};
        mesh.prisms[0][5] = 99;
        CHECK_THROWS_AS(PartDecoder(blob_of(mesh)).finish(), InvalidInput);
    }
}

SCENARIO("Damaged blobs are refused", "[session][serialization]") {
    const Scene scene = full_scene();
    WHEN("a scene is cut short anywhere") {
        const Bytes blob = encode_scene(scene);
        for (std::size_t size = 0; size < blob.size(); size += 1 + size / 7)
            CHECK_THROWS_AS(decode_scene(std::span(blob).first(size)), InvalidInput);
    }
    WHEN("a compressed part has one wrong byte") {
        const Bytes blob = encode(ScenePart(scene.surface->positions), Compression::Zstd);
        for (std::size_t at = 0; at < blob.size(); at += 1 + at / 20) {
            Bytes damaged = blob;
            damaged[at] ^= std::byte{0x55};
            // Only the header has bits that mean nothing.
            try {
                const ScenePart part = PartDecoder(damaged).finish();
                CHECK(at < 48);
            } catch (const InvalidInput&) {
                CHECK(true);
            }
        }
    }
    WHEN("a scene's bytes are wrong anywhere, it is read or refused, never a crash") {
        const Bytes blob = encode_scene(scene);
        for (std::size_t at = 0; at < blob.size(); at += 13) {
            Bytes damaged = blob;
            damaged[at] ^= std::byte{0xff};
            try {
                (void)decode_scene(damaged);
            } catch (const InvalidInput&) {
            }
        }
        CHECK(true);
    }
    WHEN("a difference names elements that are not there") {
        const ScenePart base = scene.surface->positions;
        const ScenePart other = moved(*scene.surface, 20).positions;
        const Bytes difference = encode_difference(other, base).value();
        PartDecoder decoder{ScenePart(std::make_shared<const Positions>(3))};
        CHECK_THROWS_AS(decoder.apply_difference(difference), InvalidInput);
        CHECK_THROWS_AS(PartDecoder(difference), InvalidInput);
    }
}

SCENARIO("Stored arguments keep type and bits", "[session][serialization]") {
    const Arguments arguments = {{"flag", true},
                                 {"whole", std::int64_t{-12}},
                                 {"real", 2.0},
                                 {"third", 1.0 / 3.0},
                                 {"endless", -std::numeric_limits<double>::infinity()},
                                 {"text", std::string("Jürgen \"x\"\n")},
                                 {"bytes", std::string("J\xfcrgen \x80\xc2 \xff\x01.stl")},
                                 {"at", Vec3(0.1, -2.0, 1e-17)},
                                 {"list", std::vector<double>{1.0, 2.5, 3.0}},
                                 {"nothing", std::vector<double>{}}};
    CHECK(arguments_from_stored(stored_text(arguments)) == arguments);
    CHECK_THROWS_AS(arguments_from_stored("{\"a\": null}"), InvalidInput);
    CHECK_THROWS_AS(arguments_from_stored("{\"a\": "), InvalidInput);
    CHECK_THROWS_AS(arguments_from_stored("{\"a\": {\"bytes\": \"\u20ac\"}}"), InvalidInput);
    CHECK_THROWS_AS(arguments_from_stored("{\"a\": {\"bytes\": 7}}"), InvalidInput);
    THEN("so do packed texts") {
        for (const std::string& text :
             {std::string(), std::string("short"), std::string(5000, 'x')})
            CHECK(unpack_text(pack_text(text)) == text);
        const Bytes blob = pack_text(std::string(5000, 'x'));
        CHECK_THROWS_AS(unpack_text(std::span(blob).first(20)), InvalidInput);
    }
}
