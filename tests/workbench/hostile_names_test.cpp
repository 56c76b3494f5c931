#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "meshing/products/gmsh.h"
#include "meshing/products/openfoam_case.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/recipe.h"
#include "workbench/project/serialization.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

// OpenFOAM compiles and runs what follows #codeStream, and loads the libraries of `libs`.
const std::string kCode = "inlet #codeStream { code #{ system(\"id\"); #}; }";
const std::string kLibrary = "outlet; } libs (\"/tmp/x.so\"); a {";

Surface named(Surface surface, const std::string& inlet, const std::string& outlet) {
    surface.patches[1].name = inlet;
    surface.patches[2].name = outlet;
    return surface;
}

VolumeMesh mesh_with(const std::string& name) {
    VolumeMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.tetrahedra = {{0, 1, 2, 3}};
    mesh.boundary = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    mesh.boundary_patches = {0, 1, 2, 0};
    mesh.patches = {
        {"wall", PatchKind::Wall}, {name, PatchKind::Inlet}, {"outlet_1", PatchKind::Outlet}};
    return mesh;
}

std::string all_files_in(const std::filesystem::path& folder) {
    std::string text;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) text += file_content(entry.path());
    return text;
}

}  // namespace

SCENARIO("Names consist of letters, digits, _, - and .", "[workbench][names]") {
    for (const char* name : {"inlet", "outlet_1", "A.b-2", "7"}) CHECK(is_plain_name(name));
    CHECK(is_plain_name(std::string(64, 'a')));
    for (const char* name : {"", "a b", "a;", "#a", "a,b", "a\n", "a/b", "Einla\xc3\x9f", "\x1b"})
        CHECK_FALSE(is_plain_name(name));
    CHECK_FALSE(is_plain_name(std::string(65, 'a')));
}

SCENARIO("A file's foreign names become plain ones, each once, with a note", "[workbench][names]") {
    PlainNames names;
    CHECK(names.add("outlet") == "outlet");
    CHECK(names.note().empty());
    CHECK(names.add("outlet 1") == "outlet_1");
    CHECK(names.add("outlet_1") == "outlet_1_2");
    CHECK(names.add("") == "unnamed");
    CHECK(names.add("a\x1b[31m b") == "a_31m_b");
    CHECK(names.add(std::string(100, 'x')) == std::string(64, 'x'));
    CHECK(names.add(std::string(100, 'x')) == std::string(62, 'x') + "_2");
    CHECK_THAT(names.note(), Contains("'outlet 1' is now outlet_1"));
}

SCENARIO("Texts of unknown origin are shown without terminal escapes", "[workbench][names]") {
    CHECK(printable("Gefäß\n\tno. 1") == "Gefäß\n\tno. 1");
    CHECK(printable("a\x1b]0;title\x07\r") == "a\\x1b]0;title\\x07\\x0d");
    CHECK(printable("\xff\xc2\x9b") == "\\xff\\xc2\\x9b");
    CHECK(printable("\xe2\x80\xae") == "\\xe2\\x80\\xae");  // right-to-left override
}

SCENARIO("UTF-8 is distinguished from other bytes", "[workbench][names]") {
    for (const char* text :
         {"", "plain\n", "Gef\xc3\xa4\xc3\x9f", "\xe2\x82\xac", "\xf0\x9f\x98\x80"})
        CHECK(is_utf8(text));
    for (const char* text : {"Gef\xe4\xdf", "\xc3", "\x80", "\xc0\xaf", "\xe0\x80\x80",
                             "\xed\xa0\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xff"}) {
        CHECK_FALSE(is_utf8(text));
        CHECK(is_utf8(printable(text)));
    }
}

SCENARIO("Texts that are not UTF-8 are refused before they are stored", "[workbench][names]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    write_surface(cube(10.0), folder + "/cube.stl");
    const auto run = [](const std::vector<std::string>& arguments) {
        return run_program(program_path(), arguments);
    };
    REQUIRE(run({"new", project, folder + "/cube.stl"}).exit_code == 0);
    const std::string text = "Gef\xe4\xdf";
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"note", project, "1", text},
          {"apply", project, "repair", "--note", text},
          {"apply", project, "repair", "--author", text},
          {"change", project, "1", "--note", text},
          {"change", project, "1", "--author", text},
          {"apply", project, "load-neighbour", "name=" + text, "file=" + folder + "/cube.stl"},
          {"apply", project, "repair", "unknown=" + text},
          {"apply", project, "remesh", "--variant", text}}) {
        const ProgramRun refused = run(arguments);
        INFO(arguments[0] << " " << arguments[3] << ": " << refused.err);
        CHECK(refused.exit_code == 2);
        CHECK_THAT(refused.err, !Contains("\xe4"));
        if (arguments[3] == "--note" || arguments[0] == "note")
            CHECK_THAT(refused.err, Contains("the note 'Gef\\xe4\\xdf' is not UTF-8"));
    }
    CHECK(
        run({"new", folder + "/other.vbench", folder + "/cube.stl", "--author", text}).exit_code ==
        2);
    CHECK_FALSE(std::filesystem::exists(folder + "/other.vbench"));
    const ProgramRun log = run({"log", project, "--json"});
    REQUIRE(log.exit_code == 0);
    CHECK(Json::parse(log.out)["edits"].size() == 1);
    REQUIRE(run({"note", project, "1", "Gef\xc3\xa4\xc3\x9f"}).exit_code == 0);
    CHECK(Json::parse(run({"log", project, "--json"}).out)["edits"][0]["note"] ==
          "Gef\xc3\xa4\xc3\x9f");
}

SCENARIO("A file whose name is not UTF-8 is read, and found again", "[workbench][names]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    const std::string file = folder + "/Gef\xe4\xdf.stl";
    write_surface(cube(10.0), file);
    const auto run = [](const std::vector<std::string>& arguments) {
        const ProgramRun result = run_program(program_path(), arguments);
        INFO(result.err);
        CHECK(result.exit_code == 0);
        return result.out;
    };
    CHECK(Json::accept(run({"measure", file, "--json"})));
    const Json made = Json::parse(run({"new", project, file, "--json"}));
    const Json log = Json::parse(run({"log", project, "--json"}));
    CHECK_THAT(log["edits"][0]["given"]["file"].get<std::string>(),
               Catch::Matchers::StartsWith("Gef\xef\xbf\xbd"));
    CHECK(made["edits"][0]["given"] == log["edits"][0]["given"]);
    CHECK_THAT(run({"log", project}), !Contains("\xe4"));
    run({"replay", project});
}

SCENARIO("A case's name cannot put control characters into its reports", "[workbench][names]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_text(folder + "/case.json", R"({"name": "a\u001b[31m\u0007\u009b", "phantom": "tube"})");
    const ProgramRun run =
        run_program(program_path(), {"prepare", folder, "--for", "rp", "--out", out});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::string report = file_content(out + "/report.json");
    CHECK(Json::parse(report)["input"]["name"] == "a\\x1b[31m\\x07\\xc2\\x9b");
    CHECK_THAT(report, !Contains("\\u00"));
    const std::string page = file_content(out + "/report.html");
    CHECK_THAT(page, Contains("a\\x1b[31m\\x07") && !Contains("\xc2\x9b"));
    CHECK(std::ranges::none_of(page, [](char c) { return c >= 0 && c < ' ' && c != '\n'; }));
}

SCENARIO("No operation takes a name outside the grammar", "[workbench][names]") {
    for (const auto& [operation, parameter] :
         std::vector<std::pair<std::string, std::string>>{{"clip-opening", "name"},
                                                          {"extrude-opening", "opening"},
                                                          {"load-neighbour", "name"},
                                                          {"brush-weight", "attribute"},
                                                          {"smooth", "painted"},
                                                          {"smooth", "neighbours"}}) {
        INFO(operation << " " << parameter);
        GivenArguments given(find_operation(operation));
        for (const std::string& name : {kCode, kLibrary, std::string("a,b c"), std::string("\x1b")})
            CHECK_THROWS_AS(given.set(parameter, name), UsageError);
        CHECK_NOTHROW(given.set(parameter, std::string("inlet_1")));
    }
    GivenArguments cut(find_operation("clip-opening"));
    for (const std::string& name : {kCode, kLibrary, std::string("a,b c"), std::string("\x1b")}) {
        const Arguments opening = {{"kind", std::string("outlet")}, {"name", name}};
        CHECK_THROWS_WITH(cut.set("names", Records({opening})), Contains("field 'name'"));
        CHECK_THROWS_AS(cut.set("names", "outlet:" + name), UsageError);
    }
    CHECK_NOTHROW(cut.set("names", std::string("outlet:inlet_1")));
    const Json recipe = {
        {{"operation", "clip-opening"}, {"arguments", {{"tip", {0, 0, 0}}, {"name", kCode}}}}};
    CHECK_THROWS_WITH(recipe_from_json(recipe, {}),
                      Contains("recipe, entry 1") && Contains("letters, digits"));
}

SCENARIO("Writers refuse names that other programs would run", "[workbench][names]") {
    const std::string folder = temporary_folder();
    const Surface surface = named(closed_tube(2.0, 10.0, 12, 4), kCode, "outlet_1");
    for (const char* suffix : {".ply", ".obj"}) {
        CHECK_THROWS_AS(write_surface(surface, folder + "/a" + suffix), InvalidInput);
        CHECK_FALSE(std::filesystem::exists(folder + "/a" + suffix));
    }
    Surface painted = closed_tube(2.0, 10.0, 12, 4);
    painted.attributes["x\nelement evil 1"] =
        std::make_shared<const std::vector<double>>(painted.vertex_count());
    CHECK_THROWS_AS(write_surface(painted, folder + "/b.ply"), InvalidInput);
    for (const std::string& name : {kCode, kLibrary}) {
        CHECK_THROWS_AS(write_msh(mesh_with(name), folder + "/c.msh"), InvalidInput);
        CHECK_THROWS_AS(write_openfoam_case(folder + "/case", mesh_with(name), {}), InvalidInput);
    }
    CHECK(names_in(folder).empty());
}

SCENARIO("OpenFOAM reads every plain name as a word", "[workbench][names]") {
    const std::string folder = temporary_folder() + "/case";
    write_openfoam_case(folder, mesh_with("1.5e3"), {});
    CHECK_THAT(file_content(folder + "/constant/polyMesh/boundary"), Contains("    patch_1.5e3\n"));
}

SCENARIO("A stored scene with such a name is refused", "[workbench][names]") {
    Scene scene;
    scene.surface = named(closed_tube(2.0, 10.0, 12, 4), "inlet", kLibrary);
    CHECK_THROWS_AS(decode_scene(encode_scene(scene)), InvalidInput);
    scene.surface.reset();
    scene.volume_mesh = std::make_shared<const VolumeMesh>(mesh_with(kCode));
    CHECK_THROWS_AS(decode_scene(encode_scene(scene)), InvalidInput);
}

SCENARIO("A stranger's surface with such names becomes a harmless OpenFOAM case",
         "[workbench][names]") {
    const std::string folder = temporary_folder();
    // VTP holds any name, and its reader gets what another program wrote.
    write_surface(named(fine_tube(3.0, 24.0, 18), kCode, kLibrary), folder + "/tube.vtp");
    const auto run = [](const std::vector<std::string>& arguments) {
        const ProgramRun result = run_program(program_path(), arguments);
        INFO(result.err);
        CHECK(result.exit_code == 0);
        return result.out;
    };
    const std::string project = folder + "/p.vbench";
    run({"new", project, folder + "/tube.vtp"});
    run({"apply", project, "tetrahedralize", "--variant", "cfd"});
    run({"export", project, folder + "/case/", "--variant", "cfd"});
    const std::string text = all_files_in(folder + "/case");
    CHECK_THAT(text, Contains("inlet_codeStream_code_system_id"));
    CHECK_THAT(text, Contains("outlet_libs_tmp_x.so_a"));
    CHECK_THAT(text, !Contains("#code") && !Contains("/tmp/x.so"));
}
