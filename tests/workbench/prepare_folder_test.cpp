// What `prepare` does with the folder of its results, and with what is there already.

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <stop_token>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/beginning.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/prepare.h"
#include "workbench/prepare/refusal_report.h"
#include "workbench/prepare/result_folder.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace fs = std::filesystem;

namespace {

/// A folder with a tube, a short recipe for it, and the folder `out` of its results.
struct Place {
    std::string folder;
    std::string out = folder + "/out";

    explicit Place(const std::string& where = temporary_folder()) : folder(where) {
        write_surface(closed_tube(2.0, 20.0, 16, 20), folder + "/tube.stl");
        write_text(folder + "/recipe.json", R"([{"operation": "repair"}])");
    }

    [[nodiscard]] Names command(const Names& more = {}) const {
        Names words = {"prepare",  folder + "/tube.stl",    "--units", "mm", "--for", "planning",
                       "--recipe", folder + "/recipe.json", "--out",   out};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    [[nodiscard]] ProgramRun prepared(const Names& more = {}) const { return run(command(more)); }
};

/// The results in a folder by name; of folders and of the project's files only the names: this
/// process would lose its locks on a project that it reads.
std::map<std::string, std::string> content_of(const std::string& folder) {
    std::map<std::string, std::string> content;
    for (const std::string& name : names_in(folder)) {
        const fs::path file = fs::path(folder) / name;
        const bool only_name = fs::is_directory(file) || name.starts_with("project.");
        content[name] = only_name ? "" : file_content(file);
    }
    return content;
}

}  // namespace

SCENARIO("The folder that was made of a bundled case does not hide the case",
         "[workbench][prepare]") {
    const auto case_of = [](const char* name) {
        return resolve_input({.input = name, .mask = {}, .units = {}}, {}).folder;
    };
    fs::current_path(temporary_folder());
    fs::create_directory("aneurysm");
    CHECK(case_of("aneurysm").empty());  // a folder of slices
    write_text("aneurysm/project.vbench", "");
    CHECK(case_of("aneurysm") == bundled_case("aneurysm"));
    CHECK_THROWS_AS(case_of("no-case"), IoError);
}

SCENARIO("prepare does not touch a folder whose project is open elsewhere",
         "[workbench][prepare-folder]") {
    const Place place;
    REQUIRE(place.prepared().exit_code == 0);
    const Session open = Session::open(place.out + "/project.vbench", {.find = find_operation});
    const auto before = content_of(place.out);
    for (const Names& more : {Names{}, Names{"--resume"}}) {
        const ProgramRun refused = place.prepared(more);
        INFO(refused.err);
        CHECK(refused.exit_code == 3);
        CHECK_THAT(refused.err, Contains("project.vbench") && Contains("has it open"));
        CHECK(std::ranges::count(refused.err, '\n') == 1);
        CHECK(content_of(place.out) == before);
    }
    CHECK(open.log().size() == 2);
}

SCENARIO("Of two preparations into one folder, one works and leaves a whole result",
         "[workbench][prepare-folder]") {
    const Place place;
    write_text(place.folder + "/both.sh",
               "\"$@\" 2>\"$OTHER\" &\nother=$!\n\"$@\"\none=$?\nwait $other\n"
               "echo $one $?\n");
    for (int round = 0; round < 4; ++round) {
        Names words = {place.folder + "/both.sh", test::program_path()};
        for (const std::string& word : place.command()) words.push_back(word);
        const ProgramRun both =
            run_program("/bin/bash", words, "export OTHER='" + place.folder + "/err';");
        const std::string errors = both.err + file_content(place.folder + "/err");
        INFO(both.out << errors);
        std::istringstream last(both.out.substr(both.out.rfind('\n', both.out.size() - 2) + 1));
        int one = -1, other = -1;
        last >> one >> other;
        CHECK(std::min(one, other) == 0);  // 0 is also the second one's that began after the first
        if (std::max(one, other) != 0) {
            CHECK(std::max(one, other) == 3);
            CHECK_THAT(errors, Contains("has it open"));
        }
        CHECK(fs::exists(place.out + "/report.json"));
        for (const std::string& name : names_in(place.out)) {
            if (!name.ends_with(".vbench")) continue;
            INFO(name);
            const ProgramRun log = run({"log", place.out + "/" + name, "--json"});
            REQUIRE(log.exit_code == 0);
            CHECK(Json::parse(log.out)["edits"].size() == 2);
        }
    }
}

SCENARIO("A preparation that fails at once leaves the folder of another one alone",
         "[workbench][prepare-folder]") {
    const Place place;
    write_text(place.folder + "/bad.stl", "solid\nendsolid\n");
    const auto bad = [&] {
        return run({"prepare", place.folder + "/bad.stl", "--units", "mm", "--for", "planning",
                    "--out", place.out});
    };
    WHEN("there is no folder") {
        CHECK(bad().exit_code == 3);
        CHECK_FALSE(fs::exists(place.out));
    }
    WHEN("a project in it is open") {
        fs::create_directory(place.out);
        const Session open =
            Session::create(place.out + "/project.vbench", {.find = find_operation});
        CHECK(bad().exit_code == 3);
        CHECK(fs::exists(place.out + "/project.vbench"));
        CHECK_FALSE(fs::exists(place.out + "/project.1.vbench"));
    }
}

SCENARIO("prepare keeps files of others under another name", "[workbench][prepare-folder]") {
    const std::map<std::string, std::string> own = {{"surface.stl", "a drawing"},
                                                    {"surface.vtp", "notes"},
                                                    {"report.html", "<p>a letter</p>"},
                                                    {"report.json", R"({"products": []})"}};
    static const Beginning beginning([&](const std::string& folder) {
        const Place made(folder);
        fs::create_directory(made.out);
        for (const auto& [name, text] : own) write_text(made.out + "/" + name, text);
        return std::pair(made, made.prepared());
    });
    const auto& [place, first] = beginning.again();
    INFO(first.err);
    REQUIRE(first.exit_code == 0);
    for (const auto& [name, text] : own) {
        const fs::path kept =
            fs::path(name).stem().string() + ".1" + fs::path(name).extension().string();
        CHECK(file_content(place.out / kept) == text);
        CHECK_THAT(first.err,
                   Contains("the existing " + name + " was renamed to " + kept.string()));
    }
    THEN("its own results are replaced") {
        const Names names = names_in(place.out);
        const ProgramRun again = place.prepared();
        INFO(again.err);
        REQUIRE(again.exit_code == 0);
        CHECK_THAT(again.err, !Contains("surface.stl was renamed"));
        Names more = names;
        more.emplace_back("project.1.vbench");
        std::ranges::sort(more);
        CHECK(names_in(place.out) == more);
    }
    THEN("what its report does not list is kept again") {
        write_text(place.out + "/report.json", "{ no report");
        REQUIRE(place.prepared({"--resume"}).exit_code == 0);
        CHECK(file_content(place.out + "/report.2.json") == "{ no report");
        for (const char* name : {"surface.2.stl", "surface.2.vtp", "report.2.html"})
            CHECK(fs::exists(place.out + "/" + name));
    }
    THEN("a folder of one of the names is kept, too") {
        fs::remove(place.out + "/surface.stl");
        fs::create_directory(place.out + "/surface.stl");
        write_text(place.out + "/surface.stl/scan.txt", "slices");
        REQUIRE(place.prepared({"--resume"}).exit_code == 0);
        CHECK(file_content(place.out + "/surface.2.stl/scan.txt") == "slices");
        CHECK(fs::is_regular_file(place.out + "/surface.stl"));
    }
}

SCENARIO("The report knows results of earlier preparations", "[workbench][prepare-folder]") {
    const Place place;
    const auto report = [&] { return Json::parse(file_content(place.out + "/report.json")); };
    const auto prepared_for = [&](const std::string& purpose) {
        return run({"prepare", place.folder + "/tube.stl", "--units", "mm", "--for", purpose,
                    "--recipe", place.folder + "/recipe.json", "--out", place.out});
    };
    REQUIRE(prepared_for("rp").exit_code == 0);
    CHECK(report()["earlier_results"].empty());
    const ProgramRun planned = prepared_for("planning");
    INFO(planned.err);
    REQUIRE(planned.exit_code == 0);
    CHECK(report()["earlier_results"] == Json({"print.stl", "print.3mf"}));
    CHECK_THAT(planned.err, Contains("print.stl and print.3mf in this folder are of an earlier"));
    const ProgramRun printed = prepared_for("rp");
    REQUIRE(printed.exit_code == 0);
    CHECK_THAT(printed.err, !Contains("print.stl was renamed"));
    CHECK(report()["earlier_results"].empty());
}

SCENARIO("A report that stopped knows them as well", "[workbench][prepare-folder]") {
    const fs::path folder = temporary_folder();
    const DiagnosedFailure failure(plain_text("the ends are in doubt"));
    const Json report =
        refusal_json({.purpose = "cfd"}, failure, {"surface.stl", "report.html", "../secret"});
    write_text(folder / "report.json", report.dump());
    for (const char* name : {"surface.stl", "surface.vtp", "report.html"})
        write_text(folder / name, name);
    const Names earlier = earlier_results(folder);
    CHECK(earlier == Names{"report.html", "report.json", "surface.stl"});
    CHECK(remaining_results(folder, {"report.json"}, earlier) ==
          Names{"report.html", "surface.stl"});
    Names told;
    keep_others(folder, result_names("planning"), earlier,
                [&](const std::string& text) { told.push_back(text); });
    CHECK(told == Names{"the existing surface.vtp was renamed to surface.1.vtp"});
    THEN("a page beside one that stopped first is not ours") {
        const Json first = refusal_json({.purpose = "cfd"}, failure, {});
        write_text(folder / "report.json", first.dump());
        CHECK(earlier_results(folder) == Names{"report.json"});
    }
    THEN("reports of others list nothing") {
        for (const char* text : {"", "[]", R"({"products": ["surface.stl"]})",
                                 R"({"program_version": "1"})", "\"products\""}) {
            write_text(folder / "report.json", text);
            CHECK(earlier_results(folder).empty());
        }
    }
}

SCENARIO("The author and the input's name can be given", "[workbench][prepare-folder]") {
    const Place place;
    const std::string named = place.folder + "/smith_jane.stl";
    const std::string project = place.out + "/project.vbench";
    fs::rename(place.folder + "/tube.stl", named);
    const auto authors = [&] {
        std::set<std::string> names;
        const Json log = Json::parse(run({"log", project, "--json"}).out);
        for (const Json& edit : log["edits"]) names.insert(edit["author"].get<std::string>());
        return names;
    };
    Names command = place.command({"--author", "reader-2", "--name", "case 7"});
    command[1] = named;
    WHEN("a model is prepared") {
        const ProgramRun result = run(command);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        CHECK(authors() == std::set<std::string>{"reader-2"});
        const std::string text = file_content(place.out + "/report.json");
        const Json report = Json::parse(text);
        CHECK(report["input"]["name"] == "case 7");
        for (const Json& step : report["steps"]) CHECK(step["author"] == "reader-2");
        CHECK_THAT(text, !Contains("smith"));
        CHECK_THAT(file_content(place.out + "/report.html"),
                   Contains("<title>case 7</title>") && !Contains("smith"));
    }
    WHEN("a project is made and gone on with") {
        fs::create_directory(place.out);
        REQUIRE(run({"new", project, named, "--units", "mm", "--author", "reader-1"}).exit_code ==
                0);
        CHECK(authors() == std::set<std::string>{"reader-1"});
        command.emplace_back("--resume");
        const ProgramRun resumed = run(command);
        INFO(resumed.err);
        CHECK(resumed.exit_code == 0);
        CHECK(authors() == std::set<std::string>{"reader-1", "reader-2"});
    }
    WHEN("a project is made with a name") {
        fs::create_directory(place.out);
        REQUIRE(run({"new", project, named, "--units", "mm", "--name", "case 7"}).exit_code == 0);
        command.resize(command.size() - 2);  // without the name
        command.emplace_back("--resume");
        const auto input_name = [&] {
            const ProgramRun resumed = run(command);
            INFO(resumed.err);
            REQUIRE(resumed.exit_code == 0);
            const std::string text = file_content(place.out + "/report.json");
            CHECK_THAT(text, !Contains("smith"));
            return Json::parse(text)["input"]["name"].get<std::string>();
        };
        THEN("what is prepared in it has the name") {
            CHECK(input_name() == "case 7");
        }
        THEN("another one replaces it for good") {
            command.insert(command.end(), {"--name", "case 8"});
            CHECK(input_name() == "case 8");
            command.resize(command.size() - 2);
            CHECK(input_name() == "case 8");
        }
    }
    WHEN("the name is no UTF-8") {
        const ProgramRun result = run({"new", project, named, "--name", "caf\xe9"});
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, Contains("--name 'caf\\xe9' is not UTF-8"));
    }
}

SCENARIO("A cancel is heard between the products", "[workbench][prepare-folder]") {
    const Place place;
    Names command = place.command();
    std::ranges::replace(command, std::string("planning"), std::string("rp"));
    REQUIRE(run(command).exit_code == 0);
    const bool own = GENERATE(true, false);
    if (!own) fs::remove(place.out + "/report.json");  // then the results may be the user's
    const auto before = content_of(place.out);
    std::stop_source stop;
    int written = 0;
    const Progress progress(
        [&](double, std::string_view what) {
            if (what == "writing the products" && ++written == 2) stop.request_stop();
        },
        stop.get_token());
    const PrepareOptions options{
        .input = {.input = place.folder + "/tube.stl", .mask = "", .units = "mm"},
        .purpose = "rp",
        .recipe = place.folder + "/recipe.json",
        .out = place.out,
        .resume = true};
    Names told;
    CHECK_THROWS_AS(prepare(
                        options, [&](const std::string& text) { told.push_back(text); }, progress),
                    Cancelled);
    CHECK(written == 2);
    CHECK_THAT(told.back(), Contains("the results were not written"));
    CHECK(content_of(place.out) == before);
}
