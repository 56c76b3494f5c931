// The promise on old projects: what an earlier program wrote can be opened, undone, replayed to the
// same bits and continued. Each format has a small project as SQL text (formats/write_project).

#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/project/database.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

const fs::path kFormats = fs::path(source_folder()) / "tests/workbench/formats";

/// The stored project of a format as a file.
std::string project_of_format(const fs::path& sql) {
    const std::string project = temporary_folder() + "/tube.vbench";
    Database(project, OpenMode::Create).run(file_content(sql.string()));
    return project;
}

std::int64_t format_of(const std::string& project) {
    return Database(project, OpenMode::Read).number("PRAGMA user_version");
}

Json run_json(std::vector<std::string> words) {
    words.emplace_back("--json");
    const ProgramRun run = run_program(program_path(), words);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return Json::parse(run.out);
}

std::vector<fs::path> stored_formats() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(kFormats))
        if (entry.path().extension() == ".sql") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// "2 subdivide cfd" of each edit, in the order of the steps.
std::vector<std::string> edits_of(const std::string& project) {
    std::vector<std::string> edits;
    const Json log = run_json({"log", project});
    for (const Json& edit : log["edits"])
        edits.push_back(edit["edit"].dump() + " " + edit["operation"].get<std::string>() + " " +
                        edit.value("variant", ""));
    return edits;
}

}  // namespace

SCENARIO("Projects of every format open, undo, replay and go on", "[workbench][formats]") {
    for (const fs::path& sql : stored_formats()) {
        INFO("format " << sql.stem());
        const std::string project = project_of_format(sql);
        CHECK(std::to_string(format_of(project)) == sql.stem().string());
        CHECK(edits_of(project) == std::vector<std::string>{"1 load-surface ", "3 smooth cfd",
                                                            "4 smooth rp", "2 subdivide cfd"});
        CHECK(run_json({"replay", project})["same"] == true);
        CHECK(run_program(program_path(), {"undo", project, "3"}).exit_code == 0);  // with 4
        CHECK(run_json({"replay", project})["same"] == true);
        CHECK(run_program(program_path(), {"redo", project}).exit_code == 0);
        CHECK(run_program(program_path(), {"apply", project, "subdivide"}).exit_code == 0);
        CHECK(edits_of(project) == std::vector<std::string>{"1 load-surface ", "3 smooth cfd",
                                                            "2 subdivide cfd", "6 subdivide cfd"});
        CHECK(run_program(program_path(), {"audit", project}).exit_code == 0);
    }
}

SCENARIO("The format that this program writes is among the stored ones", "[workbench][formats]") {
    const std::string folder = temporary_folder();
    const std::string project = project_of_format(stored_formats().front());
    REQUIRE(run_program(program_path(), {"export", project, folder + "/tube.vtp"}).exit_code == 0);
    REQUIRE(run_program(program_path(), {"new", folder + "/new.vbench", folder + "/tube.vtp"})
                .exit_code == 0);
    CHECK(fs::exists(kFormats / (std::to_string(format_of(folder + "/new.vbench")) + ".sql")));
}
