// Cohorts: what a batch leaves, whatever happens to its cases and to itself.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

/// Spheres with a short recipe, a file that is none, and one that is missing, whose name is code.
struct Cohort {
    std::string folder = temporary_folder();
    std::string manifest = folder + "/cases.csv";

    Cohort() {
        for (const char* name : {"small", "large"})
            write_surface(icosphere(name[0] == 's' ? 3.0 : 5.0, 2), folder + "/" + name + ".stl");
        write_text(folder + "/damaged.stl", "solid nothing");
        write_text(folder + "/recipe.json", R"([{"operation": "repair"}])");
        write_text(manifest,
                   "case,input,units\r\nball,small.stl,mm\r\n,large.stl,mm\r\n,damaged.stl,\r\n"
                   "-code,\"<script>alert(\"\"1,2\"\")<script>.stl\",\r\n");
    }

    [[nodiscard]] Names command(const std::string& out, const Names& more = {}) const {
        Names words = {"batch",    manifest,          "--for",
                       "planning", "--recipe",        folder + "/recipe.json",
                       "--out",    folder + "/" + out};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    [[nodiscard]] ProgramRun run(const std::string& out, const Names& more = {}) const {
        return run_program(test::program_path(), command(out, more));
    }

    [[nodiscard]] std::string content(const std::string& file) const {
        return file_content(fs::path(folder) / file);
    }
};

/// Locks, marks and unfinished files below a batch's folder.
Names leftovers(const std::string& out) {
    Names found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out))
        if (const std::string name = entry.path().filename().string();
            name.ends_with("-lock") || name == "batch-running" || name.starts_with(".partial-"))
            found.push_back(name);
    return found;
}

Json printed(const ProgramRun& run) {
    INFO(run.err);
    return Json::parse(run.out);
}

}  // namespace

SCENARIO("A batch prepares each case by itself; one that fails stops no other",
         "[workbench][batch]") {
    const Cohort cohort;
    const ProgramRun run = cohort.run("out", {"--json", "--jobs", "2"});
    CHECK(run.exit_code == 1);
    const Json table = printed(run);
    REQUIRE(table["cases"].size() == 4);
    CHECK(table["cases"][0]["case"] == "ball");
    CHECK(table["cases"][0]["state"] == "done");
    CHECK(table["cases"][0]["review"] == "not reviewed");
    CHECK(table["cases"][0]["figures"]["triangles"] == 320);
    CHECK(table["cases"][2]["state"] == "failed");
    CHECK(fs::exists(cohort.folder + "/out/cases/large/report.html"));
    CHECK_FALSE(fs::exists(cohort.folder + "/out/questions.html"));
    THEN("failures are grouped by their codes") {
        REQUIRE(table["failures"].size() == 1);
        CHECK(table["failures"][0]["code"] == "file-not-read");
        CHECK(table["failures"][0]["cases"] == Json{"damaged", "-code"});
    }
    THEN("the page runs no code of the texts it shows") {
        const std::string page = cohort.content("out/table.html");
        CHECK_THAT(page, Contains("&lt;script&gt;alert") && !Contains("<script>alert"));
        CHECK_THAT(page, Contains("default-src 'none'") && !Contains("unsafe-inline"));
        CHECK(page.find("http://") == std::string::npos);
        CHECK(page.find("https://") == std::string::npos);
    }
    THEN("the table for spreadsheets holds them quoted, and no formula") {
        const std::string csv = cohort.content("out/table.csv");
        CHECK_THAT(csv, Contains("\"'-code\",\"<script>alert(\"\"1,2\"\")<script>.stl\",failed"));
    }
    THEN("a second batch runs nothing, and writes the same tables") {
        const std::string csv = cohort.content("out/table.csv");
        const std::string page = cohort.content("out/table.html");
        const ProgramRun again = cohort.run("out", {"--json"});
        CHECK(again.out == run.out);
        CHECK(again.err.empty());
        CHECK(cohort.content("out/table.csv") == csv);
        CHECK(cohort.content("out/table.html") == page);
    }
    THEN("a file that has changed is prepared again, and its earlier results are kept") {
        write_surface(icosphere(4.0, 3), cohort.folder + "/small.stl");
        const Json changed = printed(cohort.run("out", {"--json"}));
        CHECK(changed["cases"][0]["figures"]["triangles"] == 1280);
        CHECK(names_in(cohort.folder + "/out/earlier") == Names{"ball.1"});
    }
    THEN("--dry-run lists what is left") {
        const ProgramRun dry = cohort.run("out", {"--dry-run", "--retry"});
        CHECK(dry.exit_code == 0);
        CHECK_THAT(dry.out, Contains("cases an hour") && Contains("2 cases left: about"));
    }
}

SCENARIO("A batch that is killed at any moment goes on to the same table", "[workbench][batch]") {
    const Cohort cohort;
    static_cast<void>(cohort.run("whole"));
    std::mt19937 random(3);
    for (int kill = 0; kill < 6; ++kill) {
        ChildProcess batch(test::program_path(), cohort.command("killed", {"--jobs", "2"}));
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 1500));
        batch.signal(SIGKILL);
        batch.wait();
    }
    CHECK(cohort.run("killed", {"--jobs", "3"}).exit_code == 1);
    CHECK(cohort.content("killed/table.csv") == cohort.content("whole/table.csv"));
    CHECK(cohort.content("killed/table.html") == cohort.content("whole/table.html"));
    CHECK(names_in(cohort.folder + "/killed/cases") == names_in(cohort.folder + "/whole/cases"));
    CHECK(leftovers(cohort.folder + "/killed").empty());
}

SCENARIO("A batch that is cancelled leaves no lock, no mark and no half of a case",
         "[workbench][batch]") {
    const Cohort cohort;
    write_surface(icosphere(5.0, 6), cohort.folder + "/large.stl");
    ChildProcess batch(test::program_path(), cohort.command("out", {"--jobs", "2"}));
    const std::string mark = cohort.folder + "/out/cases/large/batch-running";
    for (int tries = 0; tries < 60000 && !fs::exists(mark); ++tries)
        std::this_thread::sleep_for(1ms);
    batch.signal(SIGINT);
    CHECK(batch.wait() == 1);
    CHECK(leftovers(cohort.folder + "/out").empty());
    CHECK_FALSE(fs::exists(cohort.folder + "/out/cases/large"));
}

SCENARIO("The folders of inputs are in no file that a batch leaves",
         "[workbench][batch][privacy]") {
    const Cohort cohort;
    static_cast<void>(cohort.run("out", {"--jobs", "2"}));
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(cohort.folder + "/out"))
        if (file.path().filename() == "batch.json") {
            INFO(file.path().string());
            CHECK_THAT(file_content(file.path()), !Contains(cohort.folder));
        }
    THEN("what was read is known all the same") {
        CHECK(cohort.run("out").err.empty());
    }
}

SCENARIO("A case that takes too long or too much memory is ended", "[workbench][batch]") {
    const Cohort cohort;
    const auto first = [&](const Names& more) {
        Names all = {"--json"};
        all.insert(all.end(), more.begin(), more.end());
        return printed(cohort.run("out", all))["cases"][0];
    };
    CHECK(first({"--time-limit", "0.05"})["failure"]["code"] == "time-limit");
    CHECK(leftovers(cohort.folder + "/out").empty());
    CHECK(first({"--memory-limit", "0.01"})["failure"]["code"] == "memory-limit");
    THEN("other limits run it again") {
        CHECK(first({})["state"] == "done");
    }
}

SCENARIO("One batch at a time runs in a folder", "[workbench][batch]") {
    const Cohort cohort;
    ChildProcess running(test::program_path(), cohort.command("out"));
    for (int tries = 0; tries < 5000 && !fs::exists(cohort.folder + "/out/batch-lock"); ++tries)
        std::this_thread::sleep_for(1ms);
    running.signal(SIGSTOP);
    const ProgramRun second = cohort.run("out");
    CHECK(second.exit_code == 3);
    CHECK_THAT(second.err, Contains("no batch can run in 'out': another vesselbench"));
    THEN("the first one goes on") {
        running.signal(SIGCONT);
        running.wait();
    }
    THEN("the lock of a killed one holds nothing, and the next one removes it") {
        running.signal(SIGKILL);
        running.wait();
        REQUIRE(fs::exists(cohort.folder + "/out/batch-lock"));
        CHECK(cohort.run("out").exit_code == 1);  // a case of the cohort fails
        CHECK(leftovers(cohort.folder + "/out").empty());
    }
}

SCENARIO("A damaged file of a case, or a link to itself, ends no batch",
         "[workbench][batch][hostile]") {
    const Cohort cohort;
    const Json first = printed(cohort.run("out", {"--json"}));
    write_text(cohort.folder + "/out/cases/ball/batch.json", "{\"key\": [1,");
    const Json again = printed(cohort.run("out", {"--json"}));
    CHECK(again["cases"] == first["cases"]);
    CHECK(names_in(cohort.folder + "/out/earlier") == Names{"ball.1"});
    fs::create_symlink("loop.stl", cohort.folder + "/loop.stl");
    const ProgramRun folder =
        run_program(test::program_path(), {"batch", cohort.folder, "--for", "planning", "--units",
                                           "mm", "--out", cohort.folder + "/all"});
    CHECK_THAT(folder.err, Contains("left out") && Contains("loop.stl"));
}

SCENARIO("A batch leaves folders alone that are not its own", "[workbench][batch]") {
    const Cohort cohort;
    fs::create_directories(cohort.folder + "/out/cases/ball");
    write_text(cohort.folder + "/out/cases/ball/precious.txt", "mine");
    const ProgramRun run = cohort.run("out");
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, Contains("'ball' in 'cases' exists and is not of a batch"));
    CHECK(cohort.content("out/cases/ball/precious.txt") == "mine");
}

SCENARIO("A batch takes a folder, with options for all of its cases", "[workbench][batch]") {
    const Cohort cohort;
    const ProgramRun run = run_program(
        test::program_path(),
        {"batch", cohort.folder, "--for", "planning", "--units", "cm", "--set", "repair.caps=false",
         "--recipe", cohort.folder + "/recipe.json", "--out", cohort.folder + "/out", "--json"});
    CHECK_THAT(run.err,
               Contains("left out, as prepare does not read them: cases.csv, recipe.json"));
    const Json table = printed(run);
    REQUIRE(table["cases"].size() == 3);
    CHECK(table["cases"][1]["case"] == "large");
    CHECK(table["cases"][1]["figures"]["volume_mm3"].get<double>() > 400e3);  // 5 cm, not 5 mm
}

namespace {

/// The blocks of code in docs/user/batch.md.
Names code_blocks() {
    const std::string page = file_content(source_folder() + "/docs/user/batch.md");
    const std::string fence = "```";
    Names blocks;
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
        const std::size_t begin = page.find('\n', at) + 1, end = page.find(fence, begin);
        blocks.push_back(page.substr(begin, end - begin));
        at = end + fence.size();
    }
    return blocks;
}

}  // namespace

SCENARIO("The commands of docs/user/batch.md work", "[workbench][batch]") {
    const Cohort cohort;
    fs::create_directories(cohort.folder + "/surfaces");
    fs::copy(cohort.folder + "/small.stl", cohort.folder + "/surfaces");
    write_text(cohort.folder + "/answers.json",
               R"({"answers": [{"case": "small", "sha256": "of another file",
                    "ends": [{"place_mm": [0, 0, 0], "answer": "open"}]}]})");
    const Names blocks = code_blocks();
    for (const std::string& block : blocks)
        if (block.starts_with("case,")) write_text(cohort.manifest, block);
    int commands = 0;
    for (const std::string& block : blocks) {
        if (!block.starts_with("vesselbench ")) continue;
        const std::string words = block.substr(block.find(' '), block.size() - block.find(' ') - 1);
        const ProgramRun run =
            run_program("/bin/sh", {"-c", "cd \"$1\" && \"$0\"" + words + " --dry-run",
                                    test::program_path(), cohort.folder});
        INFO(block << run.err);
        CHECK(run.exit_code == 0);
        ++commands;
    }
    CHECK(commands >= 4);
}
