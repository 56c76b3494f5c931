
#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

/// Pixels that are not the background.
std::size_t drawn_pixels(const ClearPicture& picture) {
    std::size_t count = 0;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) count += picture.rgba[i] > 0 ? 1 : 0;
    return count;
}

}  // namespace

SCENARIO("A project's picture is its model's, and making it changes nothing",
         "[workbench][picture]") {
    const std::string folder = temporary_folder(), project = folder + "/ball.vbench";
    write_surface(icosphere(5.0, 3), folder + "/ball.vtp");
    REQUIRE(run({"new", project, folder + "/ball.vtp", "--units", "mm"}).exit_code == 0);
    const std::string before = file_content(project);
    // As a file manager asks for it (packaging/vesselbench.thumbnailer).
    const std::vector<std::string> thumbnail = {"picture",       "--quiet",       "--any-name",
                                                "--transparent", "--size",        "64",
                                                project,         folder + "/x.k1"};
    const ProgramRun made = run(thumbnail);
    if (made.err.find("no pictures:") != std::string::npos) return skip(made.err);
    CHECK(made.exit_code == 0);
    const auto picture = picture_from_png(file_content(folder + "/x.k1"));
    REQUIRE(picture);
    CHECK(picture->width == 64);
    CHECK(drawn_pixels(*picture) > 500);
    CHECK(file_content(project) == before);
    THEN("another name than one of a PNG file is otherwise a mistake") {
        CHECK(run({"picture", project, folder + "/x.jpg"}).exit_code == 2);
    }
}
