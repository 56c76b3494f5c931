#include <algorithm>
#include <filesystem>
#include <functional>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/inner_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// A folder "given" from a stranger beside a folder "private" of the user.
struct Folders {
    fs::path given = fs::path(temporary_folder()) / "given";
    fs::path secret = given.parent_path() / "private";

    Folders() {
        fs::create_directory(given);
        fs::create_directory(secret);
        write_text((secret / "voxels.raw").string(), "abcd");
        write_surface(cube(10.0), (secret / "cube.stl").string());
        fs::create_symlink(secret / "voxels.raw", given / "link.raw");
        fs::create_symlink(secret, given / "link");
        fs::create_symlink("loop", given / "loop");
    }
};

std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        CHECK_THAT(error.what(), !Contains("\n") && !Contains("filesystem"));
        return error.what();
    }
    return "read";
}

/// JSON with the brackets that end it.
std::string closed(std::string text) {
    std::string ends;
    for (const char c : text) ends += c == '{' ? "}" : c == '[' ? "]" : "";
    std::ranges::reverse(ends);
    return text + ends;
}

std::string nrrd(const std::string& file) {
    return "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nencoding: raw\ndata file: " + file +
           "\n";
}

std::string meta_image(const std::string& file) {
    return "ObjectType = Image\nNDims = 3\nDimSize = 2 2 1\nElementType = MET_UCHAR\n"
           "ElementDataFile = " +
           file + "\n";
}

}  // namespace

SCENARIO("A file is inside a folder after links are resolved", "[workbench][hostile]") {
    const Folders folders;
    const fs::path& given = folders.given;
    write_text((given / "a.raw").string(), "abcd");
    fs::create_symlink("a.raw", given / "alias.raw");
    fs::create_symlink(given, folders.secret / "given");
    for (const char* name : {"a.raw", "./a.raw", "missing/../a.raw", "alias.raw", "new.raw"})
        CHECK(inner_file(given, name, "its file") == given / name);
    CHECK(inner_file(given, given / "a.raw", "its file") == given / "a.raw");
    CHECK(inner_file(folders.secret / "given", "a.raw", "its file").filename() == "a.raw");
    CHECK(inner_file("", "a.raw", "its file") == "a.raw");
    for (const char* name : {"../private/voxels.raw", "..", "/etc/passwd", "link.raw",
                             "link/voxels.raw", "link/../given/../private/new.raw", "loop"})
        CHECK_THROWS_AS(inner_file(given, name, "its file"), InvalidInput);
    CHECK_THROWS_AS(inner_file(given, given.string() + "2", "its file"), InvalidInput);
}

SCENARIO("A detached header reads voxels of its own folder only", "[workbench][hostile]") {
    const Folders folders;
    const std::string header = (folders.given / "a").string();
    const std::string secret = (folders.secret / "voxels.raw").string();
    const auto error_of = [&](const std::string& name) {
        write_text(header + ".nhdr", nrrd(name));
        write_text(header + ".mhd", meta_image(name));
        const std::string error = refusal([&] { (void)read_image(header + ".nhdr"); });
        CHECK_THAT(refusal([&] { (void)read_image(header + ".mhd"); }),
                   Contains(error == "read" ? "read" : "its voxel file"));
        return error;
    };
    for (const std::string& name : {secret, std::string("../private/voxels.raw"),
                                    std::string("link.raw"), std::string("link/voxels.raw")}) {
        INFO(name);
        CHECK_THAT(error_of(name), Contains("a.nhdr: its voxel file '" + name + "'") &&
                                       Contains("private/voxels.raw', outside"));
    }
    CHECK_THAT(error_of("loop"), Contains("cannot be followed"));
    write_text((folders.given / "voxels.raw").string(), "abcd");
    CHECK(error_of("voxels.raw") == "read");
    CHECK(error_of((folders.given / "voxels.raw").string()) == "read");
    write_text(header + ".nhdr", nrrd(secret));
    const ProgramRun run =
        run_program(program_path(), {"new", header + ".vbench", header + ".nhdr"});
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, Contains("its voxel file"));
}

SCENARIO("A folder of slices has no links that lead out of it", "[workbench][hostile]") {
    const Folders folders;
    const auto slices = [&] { (void)read_image(folders.given.string()); };
    const std::string text = refusal(slices);
    CHECK_THAT(text,
               Contains("its file 'link.raw' is") && Contains("private/voxels.raw', outside"));
    fs::remove(folders.given / "link.raw");
    write_text((folders.given / "a.raw").string(), "abcd");
    fs::create_symlink("a.raw", folders.given / "alias.raw");
    CHECK_THAT(refusal(slices), Contains("contains no DICOM slices"));
}

SCENARIO("A case reads files of its own folder only", "[workbench][hostile]") {
    const Folders folders;
    const std::string description = (folders.given / "case.json").string();
    write_surface(cube(10.0), (folders.given / "cube.stl").string());
    const auto case_with = [&](const std::string& fields) {
        write_text(description, "{" + fields + "}");
        return resolve_input({.input = folders.given.string()}, {});
    };
    const std::string surface = R"("surface": "cube.stl", )";
    for (const std::string& name :
         {(folders.secret / "cube.stl").string(), std::string("../private/cube.stl"),
          std::string("link/cube.stl")})
        for (const std::string& before :
             {std::string(R"("surface": ")"), std::string(R"("image": ")"),
              surface + R"("mask": ")", surface + R"("exact": ")",
              surface + R"("recipe": [{"operation": "load-neighbour", "arguments": {"file": ")",
              surface +
                  R"("recipe": {"cfd": [{"operation": "load-neighbour", "otherwise": {"file": ")",
              surface + R"("recipe": {"rp": [{"operation": "smooth", "unless_made": {"operation":
                            "load-neighbour", "arguments": {"file": ")"}) {
            const std::string text = closed(before + name + "\"");
            INFO(text);
            CHECK_THAT(refusal([&] { (void)case_with(text); }),
                       Contains("case 'given': ") && Contains(name) &&
                           Contains("private/cube.stl', outside"));
        }
    write_text(description, R"({"surface": "../private/cube.stl"})");
    const ProgramRun run =
        run_program(program_path(), {"prepare", folders.given.string(), "--for", "rp", "--out",
                                     (folders.given / "out").string()});
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, Contains("outside the folder"));
    THEN("files of a recipe are relative to the case") {
        const Input input = case_with(surface + R"("recipe": [{"operation": "load-neighbour",
                         "arguments": {"name": "bone", "file": "cube.stl"}}])");
        const Recipe recipe = recipe_from_json(own_recipe(input, "cfd"), {"surface", "cfd"});
        CHECK(recipe.front().given->text("file") == (folders.given / "cube.stl").string());
    }
}
