// Vessel ends in doubt: the page on which a cohort asks about them, and what becomes of the
// answers.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/beginning.h"
#include "tests/support/iso_surface.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/batch/answers.h"
#include "workbench/project/content_hash.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace fs = std::filesystem;

namespace {

/// Three equal vessels that meet: nothing tells by which the blood enters.
/// \param turn of the first one [rad]
Surface star(double turn) {
    const auto body = [turn](const Vec3& p) {
        double distance = 1e9, beyond = -1e9;
        for (int arm = 0; arm < 3; ++arm) {
            const double angle = turn + arm * 2.0 * std::numbers::pi / 3.0;
            const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
            distance = std::min(distance, capsule(p, Vec3::Zero(), 15.0 * along, 1.6));
            beyond = std::max(beyond, p.dot(along) - 10.0);
        }
        return std::max(distance, beyond);
    };
    return iso_surface(body, {Vec3(-12, -12, -2.5), Vec3(12, 12, 2.5)}, 0.4);
}

ProgramRun batch(const std::string& folder, const Names& more = {}) {
    Names words = {"batch", folder + "/cases.csv", "--for", "planning", "--out", folder + "/out"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(test::program_path(), words);
}

/// A star that is in doubt, and a sphere of which no end is opened.
ProgramRun first_batch(const std::string& folder) {
    write_surface(star(0.3), folder + "/star.stl");
    write_surface(icosphere(3.0, 2), folder + "/ball.stl");
    write_text(folder + "/repair.json", R"([{"operation": "repair"}])");
    write_text(folder + "/ends.json",
               R"([{"operation": "repair"}, {"operation": "clip-opening"}])");
    write_text(folder + "/cases.csv",
               "input,units,recipe\r\nstar.stl,mm,ends.json\r\nball.stl,mm,repair.json\r\n");
    return batch(folder);
}

/// All ends of the star but the inlet are opened.
/// \param inlet which of the question's ends that are not proposed as the inlet
Json answers_for(const std::string& folder, int inlet) {
    const Json question = Json::parse(file_content(folder + "/out/cases/star/question.json"));
    Json ends = Json::array();
    for (const Json& end : question["ends"]) {
        const bool other = end["proposal"] != "inlet";
        ends.push_back(
            {{"place_mm", end["place_mm"]}, {"answer", other && inlet-- == 0 ? "inlet" : "open"}});
    }
    const Json one = {
        {"case", "star"}, {"sha256", hash_of_file(folder + "/star.stl")}, {"ends", ends}};
    return {{"answers", Json::array({one})}};
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

}  // namespace

SCENARIO("A cohort asks about vessel ends in doubt on one page, and goes on with the answers",
         "[workbench][batch]") {
    static Beginning beginning(first_batch);
    const ProgramRun& first = beginning.again();
    const std::string folder = beginning.folder(), out = folder + "/out";
    INFO(first.err);
    REQUIRE(first.exit_code == 1);
    REQUIRE(fs::exists(out + "/questions.html"));
    CHECK_THAT(first.out, Contains("questions.html (1 case)"));
    const std::string page = file_content(out + "/questions.html");
    const Json answers = answers_for(folder, 0);
    const std::string file = folder + "/given.json";
    write_text(file, answers.dump());
    THEN("the page has the case, its doubt and its ends, and no network") {
        CHECK_THAT(page, Contains("data-case=\"star\"") && !Contains("data-case=\"ball\""));
        CHECK_THAT(page, Contains("data-sha256=\"" + hash_of_file(folder + "/star.stl") + "\""));
        CHECK_THAT(page, Contains("it is not certain that the blood enters at end"));
        CHECK(count_of(page, "<tr data-place=") == 3);
        CHECK(count_of(page, " checked>") == 3);
        if (fs::exists(out + "/cases/star/question.png"))
            CHECK_THAT(page, Contains("src=\"data:image/png;base64,"));
        CHECK_THAT(page, Contains("default-src 'none'") && !Contains("unsafe-inline"));
        CHECK_THAT(page, !Contains("http://") && !Contains("https://"));
        CHECK_THAT(file_content(out + "/table.html"), Contains("href=\"questions.html\""));
    }
    THEN("a batch without answers asks the same, without running the case again") {
        CHECK(batch(folder).exit_code == 1);
        CHECK(file_content(out + "/questions.html") == page);
        CHECK_FALSE(fs::exists(out + "/earlier"));
    }
    THEN("answers finish the case, run no other one, and are kept") {
        const ProgramRun done = batch(folder, {"--answers", file});
        INFO(done.err);
        CHECK(done.exit_code == 0);
        CHECK(names_in(out + "/earlier") == Names{"star.1"});
        CHECK_FALSE(fs::exists(out + "/questions.html"));
        const Json report = Json::parse(file_content(out + "/cases/star/report.json"));
        REQUIRE(report["openings"].size() == 3);
        const Json& places = answers["answers"][0]["ends"];
        for (const Json& opening : report["openings"])
            for (const Json& end : places)
                if (std::hypot(
                        opening["centroid"][0].get<double>() - end["place_mm"][0].get<double>(),
                        opening["centroid"][1].get<double>() - end["place_mm"][1].get<double>()) <
                    2.0)
                    CHECK((opening["kind"] == "inlet") == (end["answer"] == "inlet"));
        const std::string table = file_content(out + "/table.html");
        const ProgramRun again = batch(folder);
        CHECK(again.exit_code == 0);
        CHECK(again.err.empty());
        CHECK(file_content(out + "/table.html") == table);
        CHECK(names_in(out + "/earlier") == Names{"star.1"});
        CHECK(batch(folder, {"--answers", file}).err.empty());
    }
    THEN("answers to another case, about another end, or that are none run nothing") {
        const auto refused = [&](const std::string& text) {
            write_text(file, text);
            const ProgramRun run = batch(folder, {"--answers", file});
            CHECK(run.exit_code == 3);
            CHECK_FALSE(fs::exists(out + "/earlier"));
            CHECK_FALSE(fs::exists(out + "/answers.json"));
            return run.err;
        };
        Json wrong = answers;
        wrong["answers"][0]["case"] = "comet";
        CHECK_THAT(refused(wrong.dump()), Contains("the case 'comet' is none of this batch"));
        wrong = answers;
        wrong["answers"][0]["ends"][0]["place_mm"] = {50, 0, 0};
        CHECK_THAT(refused(wrong.dump()), Contains("was not asked about an end at (50, 0, 0) mm"));
        CHECK_THAT(refused("{\"answers\": ["), Contains("given.json"));
    }
    THEN("answers about a file that has changed since are refused, and it is asked again") {
        write_surface(star(0.5), folder + "/star.stl");
        const ProgramRun run = batch(folder, {"--answers", file});
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.err, Contains("star: its new answers are refused: its input has changed"));
        CHECK_FALSE(fs::exists(out + "/answers.json"));
        CHECK_THAT(file_content(out + "/questions.html"),
                   Contains(hash_of_file(folder + "/star.stl")));
    }
}

SCENARIO("Answers become places in the arguments of a case", "[workbench][batch]") {
    const CaseAnswers answers{.sha256 = "abc",
                              .ends = {{Vec3(5, 0, -1.5), EndRole::Inlet},
                                       {Vec3(0.25, 1, 2), EndRole::Closed},
                                       {Vec3(-7, 8, 9), EndRole::Open}}};
    const BatchCase one{.name = "P01",
                        .input = "p01.stl",
                        .values = {{"units", "mm"}, {"inlet", "2"}, {"close", "4"}}};
    std::vector<std::string> arguments;
    for (const CaseValue& value : answered(one, answers).values)
        arguments.push_back(value.argument());
    CHECK(arguments == Names{"--units=mm", "--inlet=5.000000,0.000000,-1.500000",
                             "--close=0.250000,1.000000,2.000000",
                             "--open=-7.000000,8.000000,9.000000"});
    THEN("a file keeps them") {
        const std::string file = temporary_folder() + "/answers.json";
        const Answers all = {{"P01", answers}, {"P02", {.sha256 = "", .ends = answers.ends}}};
        write_text(file, text_of(all));
        CHECK(answers_in(file) == all);
    }
}

SCENARIO("A wrong file of answers is refused with the place in it", "[workbench][batch]") {
    const auto [text, words] = GENERATE(table<std::string, std::string>(
        {{"[]", "must be an object"},
         {"{}", "'answers.json'.answers must be a list"},
         {R"({"answers": [{"case": "a", "sha256": "", "ends": []}]})",
          "answers[0].ends must be a list"},
         {R"({"answers": [{"case": "a", "ends": []}]})", "answers[0] has no \"sha256\""},
         {R"({"answers": [{"case": "a", "sha256": "",
              "ends": [{"place_mm": [1, 2], "answer": "open"}]}]})",
          "ends[0].place_mm must be a list of 3 values"},
         {R"({"answers": [{"case": "a", "sha256": "",
              "ends": [{"place_mm": [1, 2, 3], "answer": "opened"}]}]})",
          "answer must be inlet, open or closed"},
         {R"({"answers": [
              {"case": "a", "sha256": "", "ends": [{"place_mm": [1, 2, 3], "answer": "open"}]},
              {"case": "a", "sha256": "", "ends": [{"place_mm": [1, 2, 3], "answer": "open"}]}]})",
          "the case 'a' has been answered above"}}));
    const std::string file = temporary_folder() + "/answers.json";
    write_text(file, text);
    CHECK_THROWS_WITH(answers_in(file), Contains(words));
    CHECK_THROWS_AS(answers_in(file), InvalidInput);
}
