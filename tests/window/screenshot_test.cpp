#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "tests/window/window_support.h"

using namespace vesselbench::test;
using Catch::Matchers::Contains;

SCENARIO("A picture of the window leaves nothing else behind", "[window][screenshot]") {
    const std::string home = temporary_folder(), input = tube_file();
    const std::string picture = home + "/window.png";
    const std::string folder = std::filesystem::path(input).parent_path();
    const ProgramRun result =
        run_program("/usr/bin/env", {"HOME=" + home, "XDG_CONFIG_HOME=" + home,
                                     "XDG_DOCUMENTS_DIR=" + home, "VESSELBENCH_GL_DEBUG=1",
                                     program_path(), "--screenshot", picture, "open", input});
    if (result.exit_code != 0 && result.err.find("OpenGL 4.3") != std::string::npos)
        return skip(result.err);
    CHECK(result.exit_code == 0);
    CHECK(names_in(home) == std::vector<std::string>{"window.png"});
    CHECK(names_in(folder) == std::vector<std::string>{"tube.stl"});
}

SCENARIO("Where OpenGL 4.3 is missing, the program says what it found", "[window][opengl]") {
    const std::string picture = temporary_folder() + "/window.png";
    const ProgramRun result = run_program(
        "/usr/bin/env", {"MESA_GL_VERSION_OVERRIDE=3.3", program_path(), "--screenshot", picture});
    if (result.exit_code == 0) return skip("this OpenGL driver cannot pretend to be an older one");
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Contains("OpenGL 4.3") && Contains("OpenGL 3.3") &&
                               Contains("command line works without it"));
    CHECK_FALSE(std::filesystem::exists(picture));
}
