// The promise on old projects: what an earlier program wrote can be opened, undone, replayed to the
// same bits and continued. Each format has a small project as SQL text, N.sql, and N-NAME.sql have
// an edit of every operation (formats/write_project).

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/operations/table.h"
#include "workbench/project/database.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

const fs::path kFormats = fs::path(source_folder()) / "tests/workbench/formats";

/// A project that is kept for what it holds.
struct KeptProject {
    std::string name;    ///< of its SQL text
    Words edits;         ///< as edits_of() lists them
    std::string middle;  ///< an edit that is undone with all that was made after it
    std::string newest;  ///< the edit up to which they are redone
};

KeptProject image_project() {
    return {.name = "2-image",
            .edits = {"1.1 load-image ", "2.1 load-neighbour ", "3.1 extract-surface ",
                      "4.2 extract-surface ", "5.1 extract-surface ", "6.1 keep-component ",
                      "7.1 crop ", "8.1 widen ", "9.1 smooth cfd", "10.1 decimate cfd"},
            .middle = "5",
            .newest = "10"};
}

KeptProject wall_project() {
    return {
        .name = "2-wall",
        .edits = {"1.1 load-surface ", "2.1 load-neighbour ", "3.1 repair ", "4.1 remove-branch ",
                  "5.1 fill-hole ", "6.1 separate ", "7.1 correct-narrowing ", "8.1 brush-smooth ",
                  "9.2 brush-inflate ", "10.1 brush-weight ", "11.1 stamp ", "12.1 smooth rp",
                  "13.1 subdivide rp", "14.1 print-check rp"},
        .middle = "6",
        .newest = "14"};
}

KeptProject sac_project() {
    return {
        .name = "2-sac",
        .edits = {"1.1 load-surface ", "2.2 mark-neck ", "3.1 subdivide rp", "4.1 mark-neck rp"},
        .middle = "3",
        .newest = "4"};
}

KeptProject purposes_project() {
    return {.name = "2-purposes",
            .edits = {"1.1 load-surface ", "2.1 repair ", "3.1 clip-opening cfd",
                      "4.1 extrude-opening cfd", "8.1 clip-opening rp", "5.1 smooth cfd",
                      "9.1 smooth rp", "10.1 part-branches rp", "11.1 deform-branch rp",
                      "6.1 remesh cfd", "12.1 decimate rp", "7.1 tetrahedralize cfd",
                      "13.2 print-check rp"},
            .middle = "10",
            .newest = "13"};
}

std::vector<KeptProject> kept_projects() {
    return {image_project(), wall_project(), sac_project(), purposes_project()};
}

/// A stored project as a file in a folder of its own.
std::string project_from(const fs::path& sql) {
    const std::string project = temporary_folder() + "/project.vbench";
    Database(project, OpenMode::Create).run(file_content(sql.string()));
    return project;
}

/// The same beside the files that it loads, which a replay reads again.
std::string project_with_sources(const KeptProject& kept) {
    const std::string project = project_from(kFormats / (kept.name + ".sql"));
    fs::copy(kFormats / "sources", fs::path(project).parent_path());
    return project;
}

std::int64_t format_of(const std::string& project) {
    return Database(project, OpenMode::Read).number("PRAGMA user_version");
}

void check_done(const Words& words) {
    const ProgramRun done = run(words);
    INFO(words[0] << ": " << done.out << done.err);
    CHECK(done.exit_code == 0);
}

Json run_json(Words words) {
    words.emplace_back("--json");
    const ProgramRun done = run(words);
    INFO(done.err);
    REQUIRE(done.exit_code == 0);
    return Json::parse(done.out);
}

std::vector<fs::path> stored_projects() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kFormats))
        if (entry.path().extension() == ".sql") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

bool is_number(const std::string& text) {
    return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// N.sql of every format.
std::vector<fs::path> stored_formats() {
    std::vector<fs::path> files = stored_projects();
    std::erase_if(files, [](const fs::path& file) { return !is_number(file.stem().string()); });
    return files;
}

/// "3.2", revision 2 of edit 3.
std::string edit_text(const Json& edit) {
    return edit["edit"].dump() + "." + edit["revision"].dump();
}

/// "3.2 smooth cfd" of each edit, in the order of the steps.
Words edits_of(const std::string& project) {
    Words edits;
    const Json log = run_json({"log", project});
    for (const Json& edit : log["edits"])
        edits.push_back(edit_text(edit) + " " + edit["operation"].get<std::string>() + " " +
                        edit.value("variant", ""));
    return edits;
}

/// The kept results are those of x86 processors with FMA: on others, the C library's sines, powers
/// and so on differ in their last bits.
bool has_kept_bits() {
#ifdef __x86_64__
    return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

/// Every edit runs again, those that load files as well.
void check_replay(const std::string& project) {
    const ProgramRun replay = run({"replay", project, "--json"});
    INFO(replay.out << replay.err);
    REQUIRE(replay.exit_code == 0);
    const Json replayed = Json::parse(replay.out);
    CHECK(replayed["same"] == true);
    for (const Json& edit : replayed["edits"]) {
        INFO(edit_text(edit));
        CHECK(edit["replayed"] == true);
    }
}

void check_undo(const std::string& project, const KeptProject& kept) {
    check_done({"undo", project});
    CHECK(edits_of(project) != kept.edits);
    check_done({"redo", project});
    CHECK(edits_of(project) == kept.edits);
    check_done({"undo", project, kept.middle});
    const Words before = edits_of(project);
    CHECK(std::ranges::none_of(
        before, [&](const std::string& edit) { return edit.starts_with(kept.middle + "."); }));
    check_done({"redo", project, kept.newest});
    if (edits_of(project) != kept.edits) check_done({"redo", project});  // the newest was changed
    CHECK(edits_of(project) == kept.edits);
}

void check_kept(const KeptProject& kept) {
    const std::string project = project_with_sources(kept);
    CHECK(kept.name.starts_with(std::to_string(format_of(project)) + "-"));
    CHECK(edits_of(project) == kept.edits);
    check_done({"audit", project});
    if (has_kept_bits())
        check_replay(project);
    else
        skip("the bits of kept results: they are those of x86 processors with FMA");
    check_undo(project, kept);
    check_done({"apply", project, "subdivide"});
    CHECK(edits_of(project).size() == kept.edits.size() + 1);
    check_done(has_kept_bits() ? Words{"audit", project, "--replay"} : Words{"audit", project});
}

/// "11.1 disputed" of each edit.
Words review_of(const std::string& project) {
    Words judged;
    const Json review = run_json({"review", project});
    for (const Json& edit : review["edits"])
        judged.push_back(edit_text(edit) + " " + edit["status"].get<std::string>());
    return judged;
}

/// The names that the openings were given by clip-opening.
Words openings_of(const std::string& project) {
    Words names;
    const Json log = run_json({"log", project});
    for (const Json& edit : log["edits"])
        if (edit["operation"] == "clip-opening")
            for (const Json& opening : edit["resolved"]["names"]) names.push_back(opening["name"]);
    return names;
}

}  // namespace

SCENARIO("Projects of every format open, undo, replay and go on", "[workbench][formats]") {
    for (const fs::path& sql : stored_formats()) {
        INFO("format " << sql.stem());
        const std::string project = project_from(sql);
        CHECK(std::to_string(format_of(project)) == sql.stem().string());
        CHECK(edits_of(project) ==
              Words{"1.1 load-surface ", "3.2 smooth cfd", "4.1 smooth rp", "2.1 subdivide cfd"});
        CHECK(run_json({"replay", project})["same"] == true);
        CHECK(run({"undo", project, "3"}).exit_code == 0);  // with 4
        CHECK(run_json({"replay", project})["same"] == true);
        CHECK(run({"redo", project}).exit_code == 0);
        CHECK(run({"apply", project, "subdivide"}).exit_code == 0);
        CHECK(edits_of(project) == Words{"1.1 load-surface ", "3.2 smooth cfd", "2.1 subdivide cfd",
                                         "6.1 subdivide cfd"});
        CHECK(run({"audit", project}).exit_code == 0);
    }
}

SCENARIO("The format that this program writes is among the stored ones", "[workbench][formats]") {
    const std::string folder = temporary_folder();
    const std::string project = project_from(stored_formats().front());
    REQUIRE(run({"export", project, folder + "/tube.vtp"}).exit_code == 0);
    REQUIRE(run({"new", folder + "/new.vbench", folder + "/tube.vtp"}).exit_code == 0);
    CHECK(fs::exists(kFormats / (std::to_string(format_of(folder + "/new.vbench")) + ".sql")));
}

SCENARIO("Every operation of the table has an edit in a kept project", "[workbench][formats]") {
    std::set<std::string> kept, table;
    for (const fs::path& sql : stored_projects()) {
        const Json log = run_json({"log", project_from(sql)});
        for (const Json& edit : log["edits"]) kept.insert(edit["operation"].get<std::string>());
    }
    for (const Operation& operation : operation_table()) table.insert(operation.name);
    CHECK(kept == table);
    THEN("each of the projects is looked at") {
        std::set<std::string> stored, looked_at;
        for (const fs::path& sql : stored_projects()) stored.insert(sql.stem().string());
        for (const fs::path& sql : stored_formats()) looked_at.insert(sql.stem().string());
        for (const KeptProject& project : kept_projects()) looked_at.insert(project.name);
        CHECK(stored == looked_at);
    }
}

SCENARIO("The kept project of an image opens, undoes, replays and goes on",
         "[workbench][formats]") {
    check_kept(image_project());
}

SCENARIO("The kept project of a wall opens, undoes, replays and goes on", "[workbench][formats]") {
    check_kept(wall_project());
}

SCENARIO("The kept project of a sac opens, undoes, replays and goes on", "[workbench][formats]") {
    check_kept(sac_project());
}

SCENARIO("The kept project of both purposes opens, undoes, replays and goes on",
         "[workbench][formats]") {
    check_kept(purposes_project());
}

SCENARIO("Kept projects hold what was decided in them", "[workbench][formats]") {
    GIVEN("a finding that was dismissed") {
        const std::string project = project_with_sources(wall_project());
        const Json dismissed = run_json({"findings", project, "--variant", "rp"})["dismissed"];
        REQUIRE(dismissed.size() == 1);
        CHECK(dismissed[0]["kind"] == "detached");
        CHECK(dismissed[0]["reason"] == "two vessels, on purpose");
    }
    GIVEN("notes and arguments") {
        const std::string project = project_with_sources(image_project());
        const Json edits = run_json({"log", project})["edits"];
        CHECK(edits[3]["given"]["threshold"] == "local");
        CHECK(edits[4]["given"]["method"] == "masked");
        CHECK(edits[4]["note"] == "the crumb beside the vessel is a body of its own");
    }
    GIVEN("verdicts of two reviewers, one of them outdated by a change") {
        const std::string project = project_with_sources(purposes_project());
        Words judged = {"1.1 accepted",  "2.1 accepted", "3.1 accepted",  "4.1 accepted",
                        "8.1 accepted",  "5.1 accepted", "9.1 accepted",  "10.1 accepted",
                        "11.1 disputed", "6.1 accepted", "12.1 accepted", "7.1 accepted",
                        "13.2 outdated"};
        CHECK(review_of(project) == judged);
        check_done({"undo", project});
        judged.back() = "13.1 accepted";
        CHECK(review_of(project) == judged);
    }
    GIVEN("openings with names, and the recipe of each purpose") {
        const std::string project = project_with_sources(purposes_project());
        const std::string folder = fs::path(project).parent_path().string();
        CHECK(openings_of(project) == Words{"inlet", "outlet_2", "outlet_1", "carotid"});
        check_done({"prepare", folder + "/fork.off", "--units", "mm", "--for", "cfd", "--resume",
                    "--out", folder});
        CHECK(edits_of(project) == purposes_project().edits);
    }
}
