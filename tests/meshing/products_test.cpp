#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "meshing/products/glb.h"
#include "meshing/products/gmsh.h"
#include "meshing/products/threemf.h"
#include "meshing/products/vtu.h"
#include "meshing/products/zip.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/commands.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::uint32_t number_at(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + place, 4);
    return value;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

}  // namespace

SCENARIO("volume files carry regions and patch names", "[meshing][products]") {
    const Surface tube = test::fine_tube(1.0, 4.0, 12);
    const VolumeMesh mesh = tetrahedralized(tube, {}).mesh;
    const std::string folder = test::temporary_folder();
    GIVEN("a Gmsh file") {
        write_msh(mesh, folder + "/volume.msh");
        const std::string text = bytes_of(folder + "/volume.msh");
        THEN("format, names and counts are right") {
            CHECK(text.starts_with("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"));
            CHECK(text.find("2 1 \"wall\"\n2 2 \"inlet\"\n2 3 \"outlet_1\"\n3 4 \"lumen\"") !=
                  std::string::npos);
            CHECK(text.find("$Elements\n" +
                            std::to_string(mesh.boundary.size() + mesh.tetrahedra.size()) + "\n") !=
                  std::string::npos);
        }
        THEN("Gmsh finds nothing to complain about") {
            const auto run = test::run_command("gmsh", {"-check", folder + "/volume.msh"});
            if (!run) return;
            CHECK(run->exit_code == 0);
            CHECK(run->output.find("Error") == std::string::npos);
        }
    }
    GIVEN("a VTU file") {
        write_vtu(mesh, folder + "/volume.vtu");
        const std::string text = bytes_of(folder + "/volume.vtu");
        THEN("it holds cells and boundary triangles with their regions") {
            CHECK(text.find("NumberOfCells=\"" +
                            std::to_string(mesh.boundary.size() + mesh.tetrahedra.size()) + "\"") !=
                  std::string::npos);
            CHECK(text.find("CellEntityIds") != std::string::npos);
            CHECK(text.find("PatchNames") != std::string::npos);
        }
    }
    GIVEN("a mesh without cells") {
        THEN("both are refused") {
            CHECK_THROWS_AS(write_msh({}, folder + "/none.msh"), InvalidInput);
            CHECK_THROWS_AS(write_vtu({}, folder + "/none.vtu"), InvalidInput);
            CHECK_FALSE(std::filesystem::exists(folder + "/none.vtu"));
        }
    }
}

SCENARIO("ZIP archives hold what was put in", "[meshing][products]") {
    const std::string text(5000, 'x');
    const std::string archive = zip_archive({{"a.txt", text}});
    REQUIRE(number_at(archive, 0) == 0x04034B50);
    const std::uint32_t packed = number_at(archive, 18), size = number_at(archive, 22);
    CHECK(size == text.size());
    std::string back(size, '\0');
    z_stream stream = {};
    REQUIRE(inflateInit2(&stream, -MAX_WBITS) == Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(archive.data() + 30 + 5));
    stream.avail_in = packed;
    stream.next_out = reinterpret_cast<Bytef*>(back.data());
    stream.avail_out = size;
    CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
    inflateEnd(&stream);
    CHECK(back == text);
    CHECK(zip_archive({{"a.txt", text}}) == archive);
}

SCENARIO("print files are manifold and in millimetres for other programs", "[meshing][products]") {
    const Surface tube = test::fine_tube(3.0, 12.0, 24);
    const std::string folder = test::temporary_folder();
    write_3mf(tube, folder + "/print.3mf");
    write_surface(tube, folder + "/print.stl");
    GIVEN("PrusaSlicer") {
        for (const std::string name : {"/print.3mf", "/print.stl"}) {
            const auto run = test::run_command("prusa-slicer", {"--info", folder + name});
            if (!run) return;
            CAPTURE(run->output);
            CHECK(run->output.find("manifold = yes") != std::string::npos);
            CHECK(run->output.find("size_z = 12.0") != std::string::npos);
        }
    }
    GIVEN("admesh") {
        const auto run = test::run_command("admesh", {folder + "/print.stl"});
        if (!run) return;
        CAPTURE(run->output);
        CHECK(run->exit_code == 0);
        CHECK(run->output.find("All facets connected.") != std::string::npos);
        CHECK(run->output.find("Facets reversed       :     0") != std::string::npos);
    }
    GIVEN("an open surface") {
        THEN("3MF is refused") {
            CHECK_THROWS_AS(write_3mf(test::open_tube(1, 2, 8, 2), folder + "/open.3mf"),
                            InvalidInput);
        }
    }
    GIVEN("a folder that does not exist") {
        THEN("that is an error of the file") {
            CHECK_THROWS_AS(write_3mf(tube, folder + "/none/print.3mf"), IoError);
        }
    }
}

SCENARIO("GLB files are well-formed", "[meshing][products]") {
    const Surface tube = test::fine_tube(3.0, 12.0, 12);
    const std::string path = test::temporary_folder() + "/vessel.glb";
    write_glb(tube, path);
    const std::string bytes = bytes_of(path);
    REQUIRE(bytes.starts_with("glTF"));
    CHECK(number_at(bytes, 8) == bytes.size());
    const std::uint32_t json_size = number_at(bytes, 12);
    const auto document = nlohmann::json::parse(bytes.substr(20, json_size));
    CHECK(document["meshes"][0]["primitives"].size() == 3);
    CHECK(document["accessors"][0]["count"] == tube.vertex_count());
    CHECK(document["buffers"][0]["byteLength"] == bytes.size() - 28 - json_size);
    CHECK(count_of(document.dump(), "\"name\":\"outlet_1\"") == 1);
}
