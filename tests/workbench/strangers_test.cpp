// Inputs as people send them: what is expected of each stands in ../shared/data/strangers.

#include <filesystem>
#include <fstream>
#include <optional>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/cross_section.h"
#include "tests/support/commands.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

/// The folder in which a script has written its files; empty: skipped.
std::optional<std::string> made_by(const std::string& script) {
    const std::string path = shared_data("strangers/" + script);
    if (path.empty()) return std::nullopt;
    const std::string folder = temporary_folder();
    const auto made = run_command("/usr/bin/python3", {path}, folder);
    if (!made) return std::nullopt;
    if (made->exit_code != 0) {
        skip(script + " needs python3-numpy and python3-vtk9");
        return std::nullopt;
    }
    return folder;
}

struct Prepared {
    ProgramRun run;
    Json report;
};

Prepared prepared(const std::string& folder, const std::string& input,
                  const std::vector<std::string>& more) {
    std::vector<std::string> words = {"prepare", folder + "/" + input, "--out", folder + "/out"};
    words.insert(words.end(), more.begin(), more.end());
    Prepared result{run_program(program_path(), words), {}};
    std::ifstream file(folder + "/out/report.json");
    if (file) result.report = Json::parse(file);
    return result;
}

std::size_t openings_of(const Json& report) {
    std::size_t count = 0;
    for (const Json& end : report.at("ends"))
        if (end.at("fate") == "opened" || end.at("fate") == "kept") ++count;
    return count;
}

}  // namespace

SCENARIO("A stenosis one voxel wide is about a voxel wide", "[workbench][strangers][real-data]") {
    const auto folder = made_by("string_sign.py");
    if (!folder) return;
    const Prepared made = prepared(*folder, "string.nii.gz", {"--for", "cfd"});
    INFO(made.run.err);
    REQUIRE(made.run.exit_code == 0);
    CHECK_THAT(made.run.err, Contains("does not say how wide") && !Contains("thin vessel"));
    const Surface surface = read_surface(*folder + "/out/surface.vtp").surface;
    for (const double z : {31.0, 32.0, 33.0}) {
        const auto section = cross_section_at(surface, {Vec3(8, 8, z), Vec3::UnitZ()});
        REQUIRE(section);
        CHECK(section->diameter() > 0.3);
        CHECK(section->diameter() < 0.6);
    }
}

SCENARIO("A mask full of missing voxels becomes the filled vessel",
         "[workbench][strangers][real-data]") {
    const auto folder = made_by("salt_mask.py");
    if (!folder) return;
    const Prepared made = prepared(*folder, "salt_mask.nii.gz", {"--for", "cfd"});
    INFO(made.run.err);
    REQUIRE(made.run.exit_code == 0);
    CHECK_THAT(made.run.err, Contains("full of holes") && Contains("closing=1"));
    CHECK(openings_of(made.report) == 2);
}

SCENARIO("A segment in its own box ends at its ends only", "[workbench][strangers][real-data]") {
    const auto folder = made_by("tight_box.py");
    if (!folder) return;
    const Prepared made = prepared(*folder, "tight_box.nii.gz", {"--for", "cfd"});
    INFO(made.run.err);
    REQUIRE(made.run.exit_code == 0);
    CHECK_THAT(made.run.err, Contains("touches the image's border"));
    CHECK(openings_of(made.report) == 2);
    for (const Json& end : made.report.at("ends"))
        if (end.at("opening") == "inlet") CHECK(end.at("diameter_mm") > 25.0);
}

SCENARIO("Bodies that overlap are one vessel", "[workbench][strangers][real-data]") {
    const auto folder = made_by("overlap.py");
    if (!folder) return;
    const Prepared made = prepared(*folder, "overlap.stl", {"--units", "mm", "--for", "cfd"});
    INFO(made.run.err);
    REQUIRE(made.run.exit_code == 0);
    CHECK(openings_of(made.report) == 3);
    THEN("a base plate is asked about, not taken for the vessel") {
        const Prepared plate = prepared(*folder, "plate.stl", {"--units", "mm", "--for", "rp"});
        CHECK(plate.run.exit_code == 2);
        CHECK_THAT(plate.run.err, Contains("cannot be a vessel") && Contains("bodies=vessel"));
    }
}

SCENARIO("Triangles of an unstructured grid are a surface", "[workbench][strangers][real-data]") {
    const auto folder = made_by("ugrid.py");
    if (!folder) return;
    const Prepared made = prepared(*folder, "ugrid.vtk", {"--units", "mm", "--for", "cfd"});
    INFO(made.run.err);
    CHECK(made.run.exit_code == 0);
}

SCENARIO("A surface that states RAS lies where the image says",
         "[workbench][strangers][real-data]") {
    const auto folder = made_by("ras_stl.py");
    if (!folder) return;
    for (const std::string name : {"tumour_ras", "tumour_lps"}) {
        const Prepared made = prepared(
            *folder, "mask.nii.gz",
            {"--neighbour", *folder + "/" + name + ".stl", "--units", "mm", "--for", "planning"});
        INFO(made.run.err);
        REQUIRE(made.run.exit_code == 0);
        CHECK(made.report.at("neighbours").at(name).at("distance_mm") == Approx(1.6).margin(0.1));
        std::filesystem::remove_all(*folder + "/out");
    }
}
