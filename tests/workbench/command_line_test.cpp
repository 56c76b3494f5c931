#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "tests/support/beginning.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "tests/support/stack_phantoms.h"
#include "workbench/report/colour_scale.h"

using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Json = nlohmann::ordered_json;

namespace {

std::vector<std::string> commands() {
    std::vector<std::string> names;
    const std::string help = run({"--help"}).out;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");)
        names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
}

/// Wrong usage: exit code 2, nothing on stdout, a text that contains all of `parts`.
void check_usage_error(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& parts) {
    const ProgramRun result = run(arguments);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK(result.out.empty());
    for (const std::string& part : parts) CHECK_THAT(result.err, Contains(part));
}

}  // namespace

SCENARIO("Help reads well at every level", "[workbench][command-line]") {
    const ProgramRun help = run({"--help"});
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.out, Contains("operations") && Contains("Exit codes"));
    CHECK(commands().size() >= 5);
    for (const std::string& command : commands()) {
        INFO(command);
        const ProgramRun result = run({command, "--help"});
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        CHECK_THAT(result.out, Contains("vesselbench " + command));
        if (command != "open" && command != "completion")  // a window, and a script of a shell
            CHECK_THAT(result.out, Contains("--json"));
    }
    CHECK_THAT(run({"--version"}).out, StartsWith("vesselbench "));
}

SCENARIO("Without a display, the window says that the command line works",
         "[workbench][command-line]") {
    const ProgramRun result =
        run_program("/usr/bin/env", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program_path()});
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Contains("no display") && Contains("command line works without it"));
}

SCENARIO("Help is a command, too", "[workbench][command-line]") {
    const auto output = [](const std::vector<std::string>& arguments) {
        const ProgramRun run = run_program(program_path(), arguments);
        CHECK(run.exit_code == 0);
        return run.out;
    };
    CHECK(output({"help"}) == output({"--help"}));
    CHECK(output({"help", "prepare"}) == output({"prepare", "--help"}));
    check_usage_error({"help", "prepar"}, {"did you mean 'prepare'"});
}

SCENARIO("Wrong usage gives exit code 2 and a helpful text", "[workbench][command-line]") {
    check_usage_error({"operation"}, {"no command 'operation'", "did you mean 'operations'"});
    check_usage_error({"view", "x"}, {"no command 'view' in this version"});
    check_usage_error({"operations", "smoth"}, {"no operation 'smoth'", "did you mean 'smooth'"});
    check_usage_error({"operations", "--jason"}, {"--jason", "vesselbench operations --help"});
    check_usage_error({"apply"}, {"PROJECT", "vesselbench apply --help"});
    check_usage_error({"undo"}, {"PROJECT"});
    check_usage_error({"apply", "p.vbench", "smooth", "lamda=1"},
                      {"smooth has no parameter 'lamda'", "did you mean 'lambda'"});
    check_usage_error({"apply", "p.vbench", "smooth", "lambda=two"},
                      {"smooth", "'lambda'", "'two'", "a number"});
    check_usage_error({"apply", "p.vbench", "smooth", "lambda"}, {"parameter=value"});
}

SCENARIO("Output that cannot be written is a failure", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), ball = folder + "/ball.vtp";
    vesselbench::write_surface(icosphere(5.0, 3), ball);
    REQUIRE(run({"new", folder + "/ball.vbench", ball}).exit_code == 0);
    const auto run_into = [](const std::string& output, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         {"-c", "\"$0\" \"$@\" >" + output, vesselbench::test::program_path()});
        return run_program("/bin/sh", arguments);
    };
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"operations", "--json"},  // more than a buffer
                                               {"operations", "smooth"},
                                               {"--version"},
                                               {"log", "--help"},
                                               {"log", folder + "/ball.vbench", "--json"},
                                               {"apply", folder + "/ball.vbench", "subdivide"},
                                               {"measure", ball}}) {
        const ProgramRun result = run_into("/dev/full", command);
        INFO(command.front() << ": " << result.err);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, StartsWith("vesselbench: the output could not be written"));
        CHECK(std::ranges::count(result.err, '\n') == 1);
    }
    THEN("so is output that nobody takes") {
        CHECK(run_into("&-", {"operations"}).exit_code == 1);
    }
    THEN("a failure of the command itself keeps its exit code") {
        CHECK(run_into("/dev/full", {"operations", "smoth"}).exit_code == 2);
    }
}

SCENARIO("With --json, a failure is a document, too", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), ball = folder + "/ball.vtp";
    vesselbench::write_surface(icosphere(5.0, 3), ball);
    const std::string project = folder + "/ball.vbench";
    REQUIRE(run({"new", project, ball}).exit_code == 0);
    const auto failure = [](std::vector<std::string> arguments, int code) {
        const ProgramRun plain = run(arguments);
        CHECK(plain.out.empty());
        arguments.emplace_back("--json");
        const ProgramRun result = run(arguments);
        INFO(arguments.front() << ": " << result.err);
        CHECK(result.exit_code == code);
        CHECK(result.err == plain.err);
        const Json json = Json::parse(result.out);
        CHECK(json["code"] == code);
        CHECK("vesselbench: " + json["error"].get<std::string>() + "\n" == result.err);
        return json;
    };
    CHECK_FALSE(failure({"operations", "smoth"}, 2).contains("edit"));
    CHECK_FALSE(failure({"measure", folder + "/no.vtp"}, 3).contains("diagnostics"));
    const Json refusal = failure({"apply", project, "extract-surface"}, 1)["diagnostics"];
    REQUIRE(refusal.size() == 1);
    CHECK(refusal[0]["code"] == "no-image");
    CHECK(refusal[0]["severity"] == "error");
    CHECK(refusal[0]["remedies"][0]["operation"] == "load-image");
    CHECK(failure({"change", project, "7"}, 2)["edit"] == 7);
    CHECK(failure({"remove", project, "8"}, 2)["edit"] == 8);
    THEN("so it is where the arguments cannot be parsed, or are not UTF-8") {
        const ProgramRun refused = run({"log", "--json"});
        CHECK(refused.exit_code == 2);
        CHECK_THAT(Json::parse(refused.out)["error"].get<std::string>(), Contains("PROJECT"));
        const ProgramRun named = run({"measure", folder + "/\xff.vtp", "--json"});
        CHECK(named.exit_code == 3);
        CHECK(Json::parse(named.out)["code"] == 3);
    }
}

SCENARIO("The operation table is printed for people and for programs",
         "[workbench][command-line]") {
    const Json table = Json::parse(run({"operations", "--json"}).out);
    REQUIRE(table["operations"].size() >= 1);
    const std::string people = run({"operations"}).out;
    for (const Json& operation : table["operations"]) {
        const std::string name = operation["name"];
        INFO(name);
        CHECK_THAT(people, Contains(name));
        const Json one = Json::parse(run({"operations", name, "--json"}).out);
        CHECK(one == operation);
        const std::string explained = run({"operations", name}).out;
        for (const char* list : {"parameters", "decisions"})
            for (const Json& parameter : operation[list])
                CHECK_THAT(explained, Contains(parameter["name"].get<std::string>()));
    }
}

SCENARIO("Decisions are no parameters, on pages and for programs", "[workbench][command-line]") {
    const Json cut = Json::parse(run({"operations", "clip-opening", "--json"}).out);
    const auto has = [&](const char* list, const std::string& name) {
        return std::ranges::any_of(cut[list],
                                   [&](const Json& each) { return each["name"] == name; });
    };
    for (const char* name : {"planes", "names", "closings"}) {
        CHECK(has("decisions", name));
        CHECK_FALSE(has("parameters", name));
    }
    CHECK(has("parameters", "tip"));
    CHECK(cut["decisions"][0]["type"] == "records");
    CHECK(cut["decisions"][0]["fields"][0]["name"] == "tip");
    CHECK(cut["decisions"][0]["fields"][0]["unit"] == "mm");
    const std::string page = run({"operations", "--markdown"}).out;
    const auto start = page.find("### clip-opening"), end = page.find("### extrude-opening");
    const std::string section = page.substr(start, end - start);
    CHECK_THAT(section, Contains("| decision |") && Contains("| planes.normal | x,y,z |"));
    CHECK(section.find("| planes |") > section.find("| decision |"));
}

SCENARIO("docs/user/operations.md matches the program", "[workbench][command-line]") {
    std::ifstream page(vesselbench::test::source_folder() + "/docs/user/operations.md");
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    INFO("renew it with scripts/docs");
    CHECK((text == run({"operations", "--markdown"}).out));
}

SCENARIO("A file that crashes its reader is bad input", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), file = folder + "/cube.vtp";
    vesselbench::write_surface(cube(3.0), file);
    std::ifstream whole(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(whole), {}};
    const std::string key = "NumberOfPoints=\"";
    const auto at = text.find(key) + key.size();
    write_text(file, text.replace(at, text.find('"', at) - at, "-1"));
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"measure", file}, {"centerlines", file, folder + "/out.vtp"}}) {
        const ProgramRun result = run(command);
        INFO(command[0] << ": " << result.err);
        CHECK(result.exit_code == 3);
        CHECK_THAT(result.err, Contains("cube.vtp"));
    }
    CHECK(names_in(folder) == std::vector<std::string>{"cube.vtp"});
}

SCENARIO("measure prints every measure of a known shape", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), ball = folder + "/ball.vtp";
    vesselbench::write_surface(icosphere(5.0, 4), ball);
    vesselbench::write_surface(icosphere(5.2, 4), folder + "/grown.vtp");
    vesselbench::write_surface(icosphere(5.2, 5), folder + "/finer.vtp");
    vesselbench::write_surface(cube(2.0), folder + "/cube.vtp");
    const auto measured = [&](const std::vector<std::string>& files,
                              std::vector<std::string> arguments = {}) {
        arguments.insert(arguments.begin(), {"measure", "--json"});
        for (const std::string& file : files) arguments.push_back(folder + file);
        return Json::parse(run(arguments).out);
    };
    const Json box = measured({"/cube.vtp"});
    CHECK(box["volume"] == Approx(8.0));
    CHECK(box["normal_curvature_deg"] == Approx(54.73561));  // of every corner
    CHECK_FALSE(box.contains("reference"));
    CHECK(box["file_units"] == "mm");
    CHECK(measured({"/cube.vtp"}, {"--units", "cm"})["file_units"] == "cm");
    const Json sphere = measured({"/ball.vtp"});
    CHECK(sphere["mean_curvature"]["integral"] == Approx(4.0 * M_PI * 5.0).epsilon(0.005));
    CHECK(sphere["mean_curvature"]["integral_abs"] == Approx(4.0 * M_PI * 5.0).epsilon(0.005));
    const Json grown = measured({"/grown.vtp", "/ball.vtp"})["reference"];
    CHECK(grown["hausdorff"] == Approx(0.2).epsilon(0.05));
    CHECK(grown["mean_distance"] == Approx(0.2).epsilon(0.02));
    CHECK(grown["volume_change_percent"] == Approx(12.4864).epsilon(1e-4));
    CHECK(grown["local_error"]["mean"] == Approx(0.2).epsilon(0.02));
    CHECK(grown["local_error"]["max"] == Approx(0.2).epsilon(0.02));
    const Json shrunk = measured({"/ball.vtp", "/grown.vtp"})["reference"];
    CHECK(shrunk["hausdorff"] == Approx(grown["hausdorff"].get<double>()));
    CHECK(shrunk["mean_distance"] == Approx(grown["mean_distance"].get<double>()));
    CHECK(shrunk["volume_change_percent"] == Approx(-11.1004).epsilon(1e-4));
    CHECK_FALSE(measured({"/finer.vtp", "/ball.vtp"})["reference"].contains("local_error"));
    const std::string people = run({"measure", folder + "/grown.vtp", ball}).out;
    CHECK_THAT(people, Contains("reference local_error max") &&
                           Contains("the file was read in mm (--units cm or m reads it"));
}

SCENARIO("centerlines refuses what a damaged file has instead of a lumen in one line",
         "[workbench][command-line]") {
    const std::string folder = temporary_folder(), file = folder + "/tube.vtp";
    const vesselbench::Surface tube = closed_tube(2.0, 20.0, 24, 40);
    const vesselbench::Vec3 damaged = tube.points()[100];
    for (const double place : {1e6, 1e20, 1e38}) {
        vesselbench::write_surface(mapped(tube,
                                          [&](const vesselbench::Vec3& p) {
                                              return p == damaged ? vesselbench::Vec3(place, 0, 0)
                                                                  : p;
                                          }),
                                   file);
        const ProgramRun result = run({"centerlines", file, folder + "/lines.vtp"});
        INFO(place << ": " << result.err);
        CHECK(result.exit_code == 3);
        CHECK(std::ranges::count(result.err, '\n') == 1);
        CHECK_THAT(result.err, Contains("encloses no lumen"));
        CHECK(names_in(folder) == std::vector<std::string>{"tube.vtp"});
    }
}

SCENARIO("centerlines says the unit in which it read the file", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), tube = folder + "/tube.vtp";
    vesselbench::write_surface(closed_tube(2.0, 20.0, 24, 40), tube);
    const std::vector<std::string> command = {"centerlines", tube, folder + "/lines.vtp"};
    CHECK_THAT(run(command).out, Contains("the file was read in mm (--units cm or m reads it"));
    auto as_json = command;
    as_json.insert(as_json.end(), {"--units", "cm", "--json"});
    const Json lines = Json::parse(run(as_json).out);
    CHECK(lines["file_units"] == "cm");
    CHECK(lines["branches"][0]["length"].get<double>() > 150.0);
}

SCENARIO("compact drops an undone volume mesh and keeps every edit", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), project = folder + "/tube.vbench";
    vesselbench::write_surface(closed_tube(2.0, 20.0, 24, 40), folder + "/tube.vtp");
    const auto done = [](const std::vector<std::string>& arguments) {
        const ProgramRun result = run(arguments);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return result.out;
    };
    done({"new", project, folder + "/tube.vtp"});
    done({"apply", project, "tetrahedralize", "size=0.4"});
    done({"undo", project});
    done({"apply", project, "tetrahedralize", "size=1"});
    const auto size = std::filesystem::file_size(project);
    CHECK_THAT(done({"compact", project}), Contains("tetrahedralize"));
    CHECK(std::filesystem::file_size(project) < size / 2);
    CHECK(Json::parse(done({"log", project, "--json"}))["edits"].size() == 2);
    done({"undo", project});
    done({"redo", project});
    done({"export", project, folder + "/kept.vtu"});
    CHECK_THAT(done({"replay", project}), !Contains("differs"));
    CHECK_THAT(done({"compact", project}), Contains("nothing to drop"));
}

SCENARIO("A project that is not there or no project is bad input", "[workbench][command-line]") {
    const std::string folder = temporary_folder();
    write_text(folder + "/text.vbench", "this is no project\n");
    for (const std::string command : {"log", "undo", "redo", "replay"})
        for (const std::string name : {"/missing.vbench", "/text.vbench"}) {
            const ProgramRun result = run({command, folder + name});
            INFO(command << name << ": " << result.err);
            CHECK(result.exit_code == 3);
            CHECK_THAT(result.err, Contains(name.substr(1)));
            CHECK(result.out.empty());
        }
    CHECK(names_in(folder) == std::vector<std::string>{"text.vbench"});
}

SCENARIO("Earlier edits are changed and removed", "[workbench][command-line]") {
    const auto json_of = [](std::vector<std::string> arguments) {
        arguments.emplace_back("--json");
        const ProgramRun result = run(arguments);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return Json::parse(result.out);
    };
    static const Beginning beginning([&](const std::string& folder) {
        const std::string ball = folder + "/ball.vbench";
        vesselbench::write_surface(icosphere(5.0, 3), folder + "/ball.vtp");
        CHECK(json_of({"new", ball, folder + "/ball.vtp"})["edits"].size() == 1);
        json_of({"apply", ball, "smooth", "iterations=3", "lambda=0.2"});
        json_of({"apply", ball, "subdivide"});
        return json_of({"change", ball, "2", "iterations=5"});
    });
    const Json& changed = beginning.again();
    const std::string folder = beginning.folder(), project = folder + "/ball.vbench";
    CHECK(changed["edit"] == 2);
    CHECK(changed["revision"] == 2);
    CHECK(changed["given"]["iterations"] == 5);
    CHECK(changed["given"]["lambda"] == 0.2);
    CHECK(changed["pending"] == Json::array({3}));
    THEN("the text names what is pending, too") {
        const ProgramRun again = run({"change", project, "2", "lambda=0.3", "--note", "less"});
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.out, StartsWith("edit 2.3: smooth") && Contains("pending now: 3 subdivi"));
        CHECK(json_of({"log", project})["edits"][1]["note"] == "less");
    }
    THEN("an edit's line is the same when it has run and in the log") {
        std::istringstream lines(run({"change", project, "2", "lambda=0.3"}).out);
        std::string line;
        REQUIRE(std::getline(lines, line));
        REQUIRE_THAT(line, StartsWith("edit 2.3: smooth: "));
        const std::string effect = line.substr(std::string("edit 2.3: smooth: ").size());
        CHECK_THAT(effect, Contains("distance up to"));
        std::string log = run({"log", project}).out;
        std::erase_if(log, [](char c) { return c == '\n' || c == ' '; });
        std::string squeezed = effect;
        std::erase(squeezed, ' ');
        CHECK_THAT(log, Contains(squeezed));
    }
    THEN("a note is written on an edit, and removed") {
        const Json noted = json_of({"note", project, "3", "for the print"});
        CHECK(noted["note"] == "for the print");
        CHECK(json_of({"log", project})["edits"][2]["note"] == "for the print");
        const ProgramRun plain = run({"note", project, "3"});
        CHECK(plain.out == "edit 3 subdivide has no note\n");
        CHECK(run({"note", project, "9", "x"}).exit_code == 2);
    }
    THEN("an edit is removed, and undo brings it back") {
        const Json removed = json_of({"remove", project, "2"});
        CHECK(removed["removed"] == 2);
        CHECK(removed["pending"] == Json::array({3}));
        CHECK(json_of({"log", project})["edits"].size() == 2);
        const Json undone = json_of({"undo", project});
        CHECK(undone["edits"] == 3);
        CHECK(undone["last"] == 3);
        CHECK_THAT(run({"remove", project, "3"}).out,
                   StartsWith("removed edit 3 subdivide\nthe case now holds 2 edits"));
        const Json back = json_of({"undo", project, "2"});
        CHECK(back["state"] == 3);
        REQUIRE(back["undone"].size() == 2);
        CHECK(back["undone"][0]["change"] == "remove");
        CHECK(back["undone"][1]["operation"] == "smooth");
        CHECK(back["undone"][1]["revision"] == 2);
        CHECK(json_of({"redo", project})["state"] == 4);
    }
    THEN("undo and redo say what they undo and redo") {
        CHECK_THAT(run({"undo", project}).out,
                   StartsWith("undone: the change of edit 2 smooth\nthe case now holds"));
        CHECK_THAT(run({"undo", project, "2"}).out,
                   StartsWith("undone: edit 3 subdivide, edit 2 smooth\n"));
        CHECK_THAT(run({"redo", project, "3"}).out,
                   StartsWith("redone: edit 2 smooth, edit 3 subdivide\n"));
    }
    THEN("replay says what has not run") {
        const ProgramRun replayed = run({"replay", project});
        CHECK(replayed.exit_code == 0);
        CHECK_THAT(replayed.out, Contains("pending: it has not run") && !Contains("intact"));
    }
    THEN("what is pending runs when it is exported") {
        const Json written = json_of({"export", project, folder + "/out.stl"});
        CHECK(written["triangles"] == 4 * 1280);
        CHECK(json_of({"log", project})["edits"][2]["status"] == "done");
        CHECK(json_of({"replay", project})["same"] == true);
    }
    THEN("an edit that does not exist is wrong usage, and so is an unknown parameter") {
        check_usage_error({"change", project, "7"}, {"no edit 7", "vesselbench log ball.vbench"});
        check_usage_error({"remove", project, "7"}, {"no edit 7"});
        check_usage_error({"change", project, "2", "iteration=5"}, {"did you mean 'iterations'"});
        check_usage_error({"change", project, "two"}, {"EDIT"});
    }
}

SCENARIO("A picture shows a vertex attribute with a scale", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), file = folder + "/ball.vtp";
    vesselbench::Surface ball = vesselbench::test::icosphere(5.0, 3);
    std::vector<double> height;
    for (const vesselbench::Vec3& p : ball.points()) height.push_back(p.z());
    ball.attributes["height"] = std::make_shared<const std::vector<double>>(height);
    vesselbench::write_surface(ball, file);
    const std::string out = folder + "/ball.png";
    check_usage_error({"picture", file, out, "--range", "0,1"}, {"--range needs --colour"});
    check_usage_error({"picture", file, out, "--colour", "height", "--range", "1,0"}, {"--range"});
    check_usage_error({"picture", file, out, "--colour", "height", "--reference", file},
                      {"--colour", "--reference"});
    const ProgramRun unknown = run({"picture", file, out, "--colour", "width"});
    CHECK(unknown.exit_code == 3);
    CHECK_THAT(unknown.err, Contains("'width'") && Contains("it has height"));
    CHECK_THAT(unknown.err, Contains("mean-curvature") && !Contains("neighbour-distance"));
    CHECK_THAT(run({"picture", "--help"}).out,
               Contains("mean-curvature") && !Contains("neighbour-distance"));
    const ProgramRun shown = run({"picture", file, out, "--colour", "height", "--size", "64"});
    if (shown.exit_code == 1 && shown.err.find("no pictures:") != std::string::npos) {
        vesselbench::test::skip(shown.err);
        return;
    }
    INFO(shown.err);
    CHECK_THAT(shown.out, Contains("height from -4.") && Contains(" to 4."));
    CHECK_THAT(
        run({"picture", file, out, "--colour", "height", "--size", "64", "--range", "0,2"}).out,
        Contains("height from 0 to 2"));
    CHECK(run({"picture", file, out, "--size", "64", "--transparent"}).exit_code == 0);
    const auto clear = vesselbench::picture_from_png(vesselbench::file_content(out));
    REQUIRE(clear);
    CHECK(clear->width == 64);
    CHECK(clear->rgba[3] == 0);
}

SCENARIO("A picture's pixels have the colours of the attribute's scale",
         "[workbench][command-line]") {
    using namespace vesselbench;
    const std::string folder = temporary_folder(), file = folder + "/tube.vtp";
    Surface tube = test::fine_tube(3.0, 12.0, 48);
    std::vector<double> height;
    for (const Vec3& p : tube.points()) height.push_back(p.z() / 12.0);
    tube.attributes["height"] = std::make_shared<const std::vector<double>>(height);
    write_surface(tube, file);
    const ProgramRun shown =
        run({"picture", file, folder + "/tube.png", "--colour", "height", "--size", "120"});
    if (shown.exit_code == 1 && shown.err.find("no pictures:") != std::string::npos) {
        test::skip(shown.err);
        return;
    }
    const Surface read = read_surface(file).surface;
    const std::vector<double>& values = *read.attributes.at("height");
    const ColourScale scale = scale_for(values);
    const Picture page = with_scale(draw(read, {.width = 120,
                                                .height = 120,
                                                .view = Vec3(0, 1, 0),
                                                .vertex_colours = colours_of(values, scale)}),
                                    scale, "height");
    std::ifstream written(folder + "/tube.png", std::ios::binary);
    const bool same = std::string(std::istreambuf_iterator<char>(written), {}) == png(page);
    CHECK(same);
    const auto pixel = [&](int x, int y) {
        const auto at = static_cast<std::ptrdiff_t>(3 * (y * page.width + x));
        return std::vector<int>(page.rgb.begin() + at, page.rgb.begin() + at + 3);
    };
    for (const double share : {0.3, 0.5, 0.7}) {
        CAPTURE(share);
        // Light scales a colour, so that the ratio of its parts stays.
        const auto seen = pixel(60, static_cast<int>(60.0 - (share - 0.5) * 120.0 / 1.06));
        const Colour expected = colour_at(scale.map, share);
        CHECK(std::pow(1.0 * seen[1] / seen[2], 2.2) ==
              Approx(expected.y() / expected.z()).epsilon(0.15));
        const auto bar = pixel(static_cast<int>((0.15 + 0.7 * share) * page.width), 120 + 22 + 7);
        const PixelColour on_bar = pixel_colour(expected);
        for (std::size_t part = 0; part < 3; ++part)
            CHECK(std::abs(bar[part] - static_cast<int>(on_bar.at(part))) <= 40);  // blended
    }
}

SCENARIO("Kept weights are exported to VTP", "[workbench][command-line]") {
    using namespace vesselbench;
    const std::string folder = temporary_folder(), project = folder + "/vessel.vbench";
    const Surface vessel = test::of_mask(test::vessel_in_slices());
    write_surface(vessel, folder + "/mask.vtp");
    REQUIRE(run({"new", project, folder + "/mask.vtp", "--units", "mm"}).exit_code == 0);
    REQUIRE(run({"apply", project, "smooth", "staircase=true", "beta_min=0", "keep_weights=true"})
                .exit_code == 0);
    REQUIRE(run({"export", project, folder + "/smooth.vtp"}).exit_code == 0);
    const Surface smooth = read_surface(folder + "/smooth.vtp").surface;
    REQUIRE(smooth.vertex_count() == vessel.vertex_count());
    for (const char* name : {"smoothing_weight", "staircase_weight", "staircase", "cap",
                             "local_error", "mean_curvature"}) {
        CAPTURE(name);
        CHECK(smooth.attributes.contains(name));
    }
    const auto& weight = *smooth.attributes.at("smoothing_weight");
    const auto& error = *smooth.attributes.at("local_error");
    std::size_t still = 0, moved = 0;
    for (std::size_t v = 0; v < weight.size(); ++v)
        if (weight[v] == 0.0) {
            ++still;
            CHECK((smooth.points()[v] - vessel.points()[v]).norm() < 1e-5);
            CHECK(error[v] < 1e-5);
        } else if (error[v] > 0.01) {
            ++moved;
        }
    CHECK(still > 0);
    CHECK(moved > 100);
}

SCENARIO("A histogram counts vertices by their distance", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), file = folder + "/ball.vtp";
    vesselbench::write_surface(vesselbench::test::icosphere(5.0, 3), file);
    vesselbench::write_surface(vesselbench::test::icosphere(4.5, 3), folder + "/small.vtp");
    check_usage_error({"measure", file, "--histogram", "0.2"}, {"REFERENCE"});
    const ProgramRun counted =
        run({"measure", file, folder + "/small.vtp", "--histogram", "0.2", "--json"});
    INFO(counted.err);
    const auto histogram =
        nlohmann::ordered_json::parse(counted.out).at("reference").at("histogram");
    CHECK(histogram.at("width") == 0.2);
    CHECK(histogram.at("vertices") == std::vector<int>{0, 0, 642});
}

SCENARIO("A picture shows a surface, or its deviation", "[workbench][command-line]") {
    const std::string folder = temporary_folder(), file = folder + "/ball.vtp";
    vesselbench::write_surface(vesselbench::test::icosphere(5.0, 3), file);
    vesselbench::write_surface(vesselbench::test::icosphere(4.5, 3), folder + "/small.vtp");
    const std::string out = folder + "/ball.png";
    check_usage_error({"picture", file}, {"OUT.png", "vesselbench picture --help"});
    check_usage_error({"picture", file, folder + "/ball.jpg"}, {"ball.jpg", ".png"});
    check_usage_error({"picture", file, out, "--view", "0,0,0"}, {"--view", "no direction"});
    check_usage_error({"picture", file, out, "--view", "1,0"}, {"--view"});
    check_usage_error({"picture", file, out, "--size", "0"}, {"--size", "8192"});
    check_usage_error({"picture", file, folder + "/ball.PNG", "--size", "0"}, {"--size", "8192"});
    check_usage_error({"picture", file, out, "--full-colour", "1"}, {"needs --reference"});
    const ProgramRun plain = run({"picture", file, out, "--size", "64", "--view=-1,0,0"});
    if (plain.exit_code == 1 && plain.err.find("no pictures:") != std::string::npos) {
        vesselbench::test::skip(plain.err);
        return;
    }
    INFO(plain.err);
    REQUIRE(plain.exit_code == 0);
    std::ifstream picture(out, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(picture), {}};
    CHECK_THAT(bytes, StartsWith("\x89PNG"));
    const auto small = [&](const std::string& view) {
        return run({"picture", file, folder + "/deviation.png", "--size", "64", "--view", view,
                    "--reference", folder + "/small.vtp"});
    };
    CHECK_THAT(small("0,0,-1").out, Contains("deviation, blue 0.5"));
    CHECK(run({"picture", folder + "/no.vtp", out}).exit_code == 3);
    CHECK(names_in(folder) ==
          std::vector<std::string>{"ball.png", "ball.vtp", "deviation.png", "small.vtp"});
}

SCENARIO("A model is exported with its neighbours and a measure, for viewers",
         "[workbench][command-line]") {
    using namespace vesselbench;
    const std::string folder = temporary_folder(), project = folder + "/tube.vbench";
    write_surface(test::fine_tube(3.0, 12.0, 24), folder + "/tube.vtp");
    write_surface(test::icosphere(2.0, 3), folder + "/ball.vtp");
    REQUIRE(run({"new", project, folder + "/tube.vtp", "--units", "mm"}).exit_code == 0);
    REQUIRE(run({"apply", project, "load-neighbour", "name=tumour", "file=" + folder + "/ball.vtp"})
                .exit_code == 0);
    const std::string glb = folder + "/model.glb", page = folder + "/model.html";
    REQUIRE(run({"export", project, glb, "--colour", "mean-curvature"}).exit_code == 0);
    CHECK_THAT(file_content(glb),
               Contains("\"tumour\"") && Contains("COLOR_0") && Contains("\"unit\":\"1/mm\""));
    THEN("a page takes title, text and a measure, unless the build has none") {
        const ProgramRun made = run({"export", project, page, "--colour", "neighbour-distance",
                                     "--title", "A tube", "--text", "<b> & a ball"});
        if (made.exit_code == 1 && made.err.find("npm") != std::string::npos) {
            test::skip(made.err);
            return;
        }
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
        CHECK_THAT(file_content(page), Contains("\"A tube\"") && Contains("\\u003cb\\u003e") &&
                                           Contains("Distance to neighbours") && !Contains(folder));
    }
    THEN("what a format cannot show is refused, and nothing is written") {
        const std::string stl = folder + "/model.stl";
        check_usage_error({"export", project, stl, "--colour", "mean-curvature"},
                          {"--colour", ".glb and .html"});
        check_usage_error({"export", project, glb, "--title", "A tube"}, {"--title", ".html"});
        check_usage_error({"export", project, stl, "--images", "slices"}, {"--images", ".html"});
        const ProgramRun unknown = run({"export", project, page, "--colour", "curvature"});
        CHECK(unknown.exit_code == 3);
        CHECK_THAT(unknown.err, Contains("mean-curvature"));
        CHECK(run({"export", project, page, "--images", "slices"}).exit_code == 3);  // no image
        CHECK_FALSE(std::filesystem::exists(stl));
        CHECK_FALSE(std::filesystem::exists(page));
    }
}
