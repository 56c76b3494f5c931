#include "workbench/case/label_choice.h"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/project/serialization.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace fs = std::filesystem;

namespace {

const std::vector<Segment> kSegments = {{.label = 1, .name = "artery"},
                                        {.label = 2, .name = "bone, left"},
                                        {.label = 5, .name = "Artery wall"}};
const std::vector<int> kThere = {1, 2, 3, 5};

/// The labels that `new` has as the vessel, by the extraction that follows.
double volume_ml(const std::string& project) {
    const ProgramRun extracted = run({"apply", project, "extract-surface", "--json"});
    REQUIRE(extracted.exit_code == 0);
    Session session = Session::open(project, {.find = find_operation});
    return volume(*session.scene("").surface) / 1000.0;
}

Json step_report(const std::string& folder, const std::string& operation) {
    std::ifstream file(folder + "/report.json");
    const Json report = Json::parse(file);
    for (const Json& step : report.at("steps"))
        if (step.at("operation") == operation) return step.at("report");
    return {};
}

Image two_balls() {
    const Image grid = ball_image(4.0, 30, Vec3(0.8, 0.8, 0.8));
    const Vec3 middle = middle_of(grid);
    return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return (p - middle - Vec3(0, 0, 5)).norm() < 4.0   ? 1.0
               : (p - middle + Vec3(0, 0, 5)).norm() < 5.0 ? 2.0
                                                           : 0.0;
    });
}

/// A label map with a table beside it.
std::string named_labels() {
    const std::string folder = temporary_folder();
    write_image(folder + "/seg.nii.gz", two_balls());
    std::ofstream(folder + "/seg.json") << R"({"sac": 1, "vein": 2})";
    return folder + "/seg.nii.gz";
}

}  // namespace

SCENARIO("Labels are chosen by name or number", "[workbench][labels]") {
    CHECK(labels_named("artery", kSegments, kThere) == std::vector<int>{1});
    CHECK(labels_named("ARTERY WALL", kSegments, kThere) == std::vector<int>{5});
    CHECK(labels_named("bone, left", kSegments, kThere) == std::vector<int>{2});
    CHECK(labels_named("5, artery", kSegments, kThere) == std::vector<int>{1, 5});
    CHECK(labels_named("3", kSegments, kThere) == std::vector<int>{3});
    CHECK(labels_named("all", kSegments, kThere) == kThere);
    CHECK_THROWS_WITH(labels_named("atery", kSegments, kThere),
                      Contains("did you mean 'artery'") && Contains("artery (1)"));
    CHECK_THROWS_WITH(labels_named("4", kSegments, kThere), Contains("no label '4'"));
    CHECK_THROWS_WITH(labels_named("artery", kSegments, {2}), Contains("'artery' is empty"));
    CHECK_THROWS_AS(labels_named("", kSegments, kThere), UsageError);
}

SCENARIO("The names of segments are kept with a scene", "[workbench][labels]") {
    Scene scene;
    scene.image = two_balls();
    const Bytes without = take_apart(scene).manifest;
    CHECK(without.front() == std::byte{1});  // as before there were names
    scene.segmentation = {.segments = kSegments, .vessel = {1, 5}};
    scene.segmentation.segments[0].colour = {1, 2, 3};
    const SceneParts parts = take_apart(scene);
    CHECK(put_together(parts.manifest, parts.parts).segmentation == scene.segmentation);
    Bytes cut = parts.manifest;
    cut.resize(cut.size() - 3);
    CHECK_THROWS_AS(put_together(cut, parts.parts), InvalidInput);
}

SCENARIO("Several labels of which none is chosen make nothing", "[workbench][labels]") {
    const std::string labels = named_labels(), out = temporary_folder() + "/out";
    GIVEN("no choice") {
        const ProgramRun asked = run({"prepare", labels, "--for", "rp", "--out", out});
        THEN("the labels are listed with names, volumes and sizes, and how to choose") {
            CHECK(asked.exit_code == 2);
            CHECK_THAT(asked.err, Contains("1      sac   0.26") && Contains("2      vein") &&
                                      Contains(" ml") && Contains(" mm") &&
                                      Contains("--label sac"));
            CHECK_FALSE(fs::exists(out + "/project.vbench"));
            CHECK_FALSE(fs::exists(out + "/report.json"));
        }
        THEN("each label is an answer, with its command") {
            const ProgramRun again =
                run({"prepare", labels, "--for", "rp", "--out", out, "--json"});
            const Json question = Json::parse(again.out).at("diagnostics").at(0);
            REQUIRE(question.at("remedies").size() == 2);
            CHECK(question["remedies"][1]["arguments"]["label"] == "vein");
            auto command = question["remedies"][1]["commands"][0].get<std::vector<std::string>>();
            command.erase(command.begin());
            const ProgramRun answered = run(command);
            INFO(answered.err);
            CHECK(answered.exit_code == 0);
        }
        THEN("ends asks as well") {
            CHECK(run({"ends", labels}).exit_code == 2);
        }
        THEN("new lists them, and the project stays open for a choice") {
            const std::string project = temporary_folder() + "/p.vbench";
            const ProgramRun made = run({"new", project, labels});
            CHECK(made.exit_code == 0);
            CHECK_THAT(made.out + made.err, Contains("vein"));
        }
    }
    GIVEN("a name") {
        const std::string project = temporary_folder() + "/p.vbench";
        REQUIRE(run({"new", project, labels, "--label", "sac"}).exit_code == 0);
        CHECK(volume_ml(project) == Approx(4.0 / 3.0 * 3.1416 * 64.0 / 1000.0).epsilon(0.05));
        CHECK(run({"replay", project}).exit_code == 0);
    }
    GIVEN("a name that is none") {
        const ProgramRun refused =
            run({"prepare", labels, "--for", "rp", "--out", out, "--label", "sack"});
        CHECK(refused.exit_code == 2);
        CHECK_THAT(refused.err, Contains("did you mean 'sac'"));
        CHECK_FALSE(fs::exists(out + "/project.vbench"));
    }
    GIVEN("a surface") {
        const std::string sphere = source_folder() + "/README.md";
        CHECK(run({"prepare", sphere, "--for", "rp", "--out", out, "--label", "1"}).exit_code != 0);
    }
}

SCENARIO("A segment is a neighbour by its name", "[workbench][labels]") {
    const std::string project = temporary_folder() + "/p.vbench";
    REQUIRE(
        run({"new", project, named_labels(), "--label", "sac", "--neighbour", "vein"}).exit_code ==
        0);
    Session session = Session::open(project, {.find = find_operation});
    const Scene scene = session.scene("");
    REQUIRE(scene.neighbours.contains("vein"));
    CHECK(volume(scene.neighbours.at("vein")) == Approx(523.6).epsilon(0.05));
    CHECK(run({"new", temporary_folder() + "/q.vbench", named_labels(), "--neighbour", "vain"})
              .exit_code == 2);
}

SCENARIO("A batch has a column for the label", "[workbench][labels][batch]") {
    const std::string labels = named_labels(), folder = fs::path(labels).parent_path().string();
    std::ofstream(folder + "/cases.csv") << "case,input,label\na,seg.nii.gz,sac\nb,seg.nii.gz,\n";
    const ProgramRun batch =
        run({"batch", folder + "/cases.csv", "--for", "planning", "--out", folder + "/out"});
    CHECK(batch.exit_code == 1);
    CHECK(fs::exists(folder + "/out/cases/a/surface.stl"));
    CHECK_FALSE(fs::exists(folder + "/out/cases/b/surface.stl"));
    CHECK_THAT(batch.out, Contains("label-unchosen"));
}

SCENARIO("Segmentations of 3D Slicer become the vessel that is chosen",
         "[workbench][labels][real-data]") {
    const std::string two = shared_data("slicer/two.seg.nrrd");
    if (two.empty()) return;
    const std::string folder = fs::path(two).parent_path().string();
    GIVEN("two segments and no choice") {
        const std::string out = temporary_folder() + "/out";
        const ProgramRun asked = run({"prepare", two, "--for", "rp", "--out", out});
        CHECK(asked.exit_code == 2);
        CHECK_THAT(asked.err, Contains("artery") && Contains("26.9 ml") && Contains("bone") &&
                                  Contains("--label artery"));
        CHECK_FALSE(fs::exists(out + "/project.vbench"));
    }
    GIVEN("the artery, on the whole grid, on a part of it, flipped, alone, or in a layer") {
        for (const auto& [file, label] : {std::pair{"two", "artery"},
                                          {"cropped", "1"},
                                          {"flipped", ""},
                                          {"plain", ""},
                                          {"overlap", "artery"}}) {
            INFO(file);
            std::vector<std::string> words = {"new", temporary_folder() + "/p.vbench",
                                              folder + "/" + file + ".seg.nrrd"};
            if (*label != '\0') words.insert(words.end(), {"--label", label});
            REQUIRE(run(words).exit_code == 0);
            CHECK(volume_ml(words[1]) == Approx(26.3).epsilon(0.01));
        }
    }
    GIVEN("the artery on a part of the grid, a side of which its wall touches, for a print") {
        const std::string out = temporary_folder() + "/out";
        REQUIRE(run({"prepare", folder + "/cropped.seg.nrrd", "--label", "artery", "--for", "rp",
                     "--out", out})
                    .exit_code == 0);
        const Json report = step_report(out, "extract-surface");
        CHECK(report.at("lumen").at("grazes") == 1);
        CHECK(report.at("volume_mm3") == Approx(26400.0).epsilon(0.005));
    }
    GIVEN("segments that overlap, and no choice") {
        const ProgramRun asked = run({"prepare", folder + "/overlap.seg.nrrd", "--for", "rp",
                                      "--out", temporary_folder() + "/out"});
        CHECK(asked.exit_code == 2);
        CHECK_THAT(asked.err, Contains("artery wall") && Contains("--label artery"));
    }
}

SCENARIO("A drawn artery stays what was drawn", "[workbench][labels][wall][real-data]") {
    const std::string ct = shared_data("slicer/ct.nrrd");
    if (ct.empty()) return;
    const std::string folder = fs::path(ct).parent_path().string();
    const auto prepared = [&](const std::string& mask, const std::vector<std::string>& more) {
        const std::string out = temporary_folder() + "/out";
        std::vector<std::string> words = {"prepare", ct,      "--mask", folder + "/" + mask,
                                          "--for",   "rp",    "--out",  out,
                                          "--label", "artery"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun made = run(words);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
        return step_report(out, "extract-surface");
    };
    GIVEN("the mask on a part of the image's grid") {
        const Json report = prepared("cropped.seg.nrrd", {});
        THEN("the wall is the mask's, moved by a voxel at most") {
            CHECK(report.at("method") == "wall");
            CHECK(report.at("volume_mm3") == Approx(26300.0).epsilon(0.1));
            CHECK(report.at("distance_from_mask_mm").at("largest") < 3.3);
            CHECK_THAT(report.at("headline").get<std::string>(),
                       Contains("the mask as the wall") && Contains("from the mask"));
        }
    }
    GIVEN("the ways to take it as a region") {
        const Json report = prepared("two.seg.nrrd", {"--mask-is", "region"});
        CHECK(report.at("method") == "masked");
        CHECK(report.at("volume_mm3") == Approx(31000.0).epsilon(0.02));
        CHECK_THAT(report.at("headline").get<std::string>(), Contains("the mask as a region"));
        CHECK(prepared("two.seg.nrrd", {"--set", "extract-surface.dilation=0"}).at("method") ==
              "masked");
    }
}
