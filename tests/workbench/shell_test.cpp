// Completions of shells, the manual page and the handbook.

#include <chrono>
#include <filesystem>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// A file with what the command prints.
std::string printed(const std::vector<std::string>& arguments) {
    const ProgramRun run = run_program(test::program_path(), arguments);
    REQUIRE(run.exit_code == 0);
    const std::string file = temporary_folder() + "/printed";
    write_text(file, run.out);
    return file;
}

bool has_program(const std::string& name) {
    return run_program("/bin/sh", {"-c", "command -v " + name}).exit_code == 0;
}

/// What bash offers for the last of these words.
std::string offered(const std::string& words) {
    static const std::string file = printed({"completion", "bash"});
    const std::string script = "source " + file + "; COMP_WORDS=(vesselbench " + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _vesselbench; "
                               "echo \"${COMPREPLY[*]}\"";
    const ProgramRun run = run_program("/bin/bash", {"-c", script});
    CHECK(run.err.empty());
    return run.out;
}

}  // namespace

SCENARIO("bash completes what the tables hold", "[workbench][shell]") {
    CHECK(offered("pre") == "prepare\n");
    CHECK(offered("prepare in.stl --for ''") == "cfd rp planning simulation\n");
    CHECK(offered("prepare in.stl --re") == "--recipe --refine --resume\n");
    CHECK(offered("batch cases.csv --engine ''") == "local slurm\n");
    CHECK(offered("prepare in.stl --recipe fine") == "fine-print\n");
    CHECK(offered("suggest in.stl --filter lap") == "laplace laplace-hc\n");
    CHECK(offered("prepare in.stl --set remesh.print") == "remesh.print_resolution=\n");
    CHECK(offered("prepare in.stl --set smooth.filter = la") == "laplace laplace-hc\n");
    CHECK(offered("export p.vbench case --set openfoam.prof") == "openfoam.profile=\n");
    CHECK(offered("export p.vbench case --set openfoam.profile = p") == "parabolic plug\n");
    CHECK(offered("export p.vbench case --set remesh") == "\n");
    CHECK_THAT(offered("apply p.vbench re"), Contains("remesh") && Contains("repair"));
    CHECK(offered("apply p.vbench smooth it") == "iterations=\n");
    CHECK(offered("apply p.vbench smooth filter = la") == "laplace laplace-hc\n");
    THEN("where nothing fits, the shell completes files") {
        CHECK(offered("prepare ''") == "\n");
        CHECK(offered("measure ''") == "\n");
    }
    THEN("hidden commands are not offered") {
        CHECK(offered("manu") == "\n");
    }
}

SCENARIO("Other shells read their completions", "[workbench][shell]") {
    for (const std::string shell : {"zsh", "fish"}) {
        if (!has_program(shell)) {
            skip("no " + shell);
            continue;
        }
        const ProgramRun read = run_program(shell, {"-n", printed({"completion", shell})});
        INFO(read.err);
        CHECK(read.exit_code == 0);
    }
    if (has_program("fish")) {
        const auto fish = [&](const std::string& typed) {
            const std::string file = printed({"completion", "fish"});
            return run_program("fish", {"--no-config", "-c",
                                        "source " + file + "; complete -C '" + typed + "'"})
                .out;
        };
        CHECK_THAT(fish("vesselbench apply p.vbench smooth filter=la"),
                   Contains("filter=laplace-hc"));
        CHECK_THAT(fish("vesselbench prepare in.stl --recipe fine"), Contains("fine-print"));
        CHECK_THAT(fish("vesselbench prepare in.stl --set smooth.fil"), Contains("smooth.filter="));
    }
    CHECK(run_program(test::program_path(), {"completion", "tcsh"}).exit_code == 2);
}

SCENARIO("The manual page explains every command and lists every operation", "[workbench][shell]") {
    const ProgramRun manual = run_program(test::program_path(), {"manual"});
    CHECK_THAT(manual.out, Contains(".SS \"prepare INPUT\"") && Contains("clip\\-opening") &&
                               Contains(".SH EXIT STATUS") && Contains(".SH FILES") &&
                               Contains(".SH SEE ALSO"));
    if (!has_program("groff")) return skip("no groff");
    const ProgramRun read =
        run_program("groff", {"-man", "-ww", "-z", "-Tutf8", printed({"manual"})});
    CHECK(read.err.empty());
    CHECK(read.exit_code == 0);
}

SCENARIO("docs shows the handbook of the installation", "[workbench][shell]") {
    namespace fs = std::filesystem;
    const std::string above = temporary_folder();
    const fs::path folder = fs::path(above) / "a place";
    const fs::path site = folder / "share/doc/vesselbench/html", bin = folder / "bin";
    fs::create_directories(bin);
    fs::copy_file(test::program_path(), bin / "vesselbench");
    const auto docs = [&](std::vector<std::string> words, const std::string& display) {
        words.insert(
            words.begin(),
            {"-u", "WAYLAND_DISPLAY", "DISPLAY=" + display, "PATH=" + bin.string() + ":/bin",
             "XDG_CACHE_HOME=" + folder.string(), (bin / "vesselbench").string(), "docs"});
        return run_program("/usr/bin/env", words);
    };
    WHEN("the handbook is not installed") {
        const ProgramRun run = docs({}, "");
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.err, Contains("scripts/docs makes it"));
    }
    fs::create_directories(site);
    write_text((site / "index.html").string(), "pages");
    const std::string address =
        "file://" + above + "/a%20place/share/doc/vesselbench/html/index.html";
    WHEN("there is no display") {
        const ProgramRun run = docs({"bent", "inlet?"}, "");
        CHECK(run.exit_code == 0);
        CHECK(run.out == address + "?q=bent%20inlet%3F\n");
        CHECK_THAT(run.err, Contains("no browser"));
    }
    WHEN("there is a desktop") {
        const std::string opened = (folder / "opened").string();
        write_text((bin / "xdg-open").string(), "#!/bin/sh\nprintf %s \"$1\" > '" + opened +
                                                    ".new'; mv '" + opened + ".new' '" + opened +
                                                    "'\n");
        fs::permissions(bin / "xdg-open", fs::perms::owner_all);
        const auto told = [&] {
            while (!fs::exists(opened)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
            return file_content(opened);
        };
        THEN("its browser opens the page") {
            CHECK(docs({}, ":0").out == address + "\n");
            CHECK(told() == (site / "index.html").string());
        }
        THEN("words lead to the search") {
            CHECK(docs({"inlet"}, ":0").exit_code == 0);
            CHECK_THAT(file_content(told()), Contains("url=" + address + "?q=inlet"));
        }
    }
}
