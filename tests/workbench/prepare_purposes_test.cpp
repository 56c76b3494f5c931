// Models for treatment planning and for surgery simulation (thesis Table 2.1), and several models
// of one project.

#include <algorithm>
#include <cmath>
#include <tuple>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/beginning.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace {

/// A built-in phantom as a case folder.
std::string phantom(const std::string& name) {
    const std::string folder = temporary_folder() + "/phantom-" + name;
    REQUIRE(run({"phantom", name, "--out", folder}).exit_code == 0);
    return folder;
}

/// Prepares and returns the report.
Json prepared(const std::string& input, const std::string& purpose, const std::string& out,
              const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"prepare", input, "--for", purpose, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun result = run(words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return Json::parse(file_content(out + "/report.json"));
}

/// The edits of a project's log.
Json edits_in(const std::string& project) {
    return Json::parse(run({"log", project, "--json"}).out)["edits"];
}

/// Volume of a variant's surface [mm^3].
double exported_volume(const std::string& project, const std::string& variant) {
    const std::string file = temporary_folder() + "/" + variant + ".vtp";
    REQUIRE(run({"export", project, file, "--variant", variant}).exit_code == 0);
    return Json::parse(run({"measure", file, "--json"}).out)["volume"];
}

double length_of(const Json& report) {
    const Json& bounds = report["quality"]["after"]["bounds"];
    return bounds[5].get<double>() - bounds[2].get<double>();
}

double least_distance(const Surface& a, const Surface& b) {
    double least = 1e9;
    for (const SurfacePoint& found : SurfaceDistance(b).closest_points(a.points()))
        least = std::min(least, found.distance);
    return least;
}

}  // namespace

SCENARIO("A phantom becomes a model for planning and one for surgery simulation",
         "[workbench][prepare]") {
    for (const std::string purpose : {"planning", "simulation"}) {
        CAPTURE(purpose);
        const std::string out = temporary_folder() + "/" + purpose;
        const ProgramRun result = run({"prepare", phantom("tube"), "--for", purpose, "--out", out});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        CHECK(names_in(out) ==
              Names{"project.vbench", "report.html", "report.json", "surface.stl", "surface.vtp"});
        const Json report = Json::parse(file_content(out + "/report.json"));
        CHECK(report["purpose"] == purpose);
        const double skewness = report["quality"]["after"]["equiangle_skewness"]["mean"];
        CHECK((purpose == "planning") == (skewness > 0.2));  // only simulation asks for good ones
        CHECK_THAT(file_content(out + "/report.html"), Contains("Model for"));
        REQUIRE(report["requirements"].size() == 6);
        CHECK(report["requirements"][0]["figures"]["largest_mm"].is_number());
        CHECK_THAT(file_content(out + "/report.html"),
                   Contains("<h2>Requirements</h2>") && Contains("triangle size homogeneity"));
    }
}

SCENARIO("A mask's model for simulation is smoother than the one for planning",
         "[workbench][prepare]") {
    const std::string mask = phantom("vessel") + "/mask.nii.gz";
    const auto figures = [&](const std::string& purpose) {
        return prepared(mask, purpose, temporary_folder() + "/mask-" + purpose)["quality"]["after"];
    };
    const Json planning = figures("planning"), simulation = figures("simulation");
    CAPTURE(planning.dump(), simulation.dump());
    // The absolute mean curvature beyond that of a convex wall, whatever the triangles' size.
    const auto roughness = [](const Json& quality) {
        const Json& curvature = quality["mean_curvature"];
        return curvature["integral_abs"].get<double>() / curvature["integral"].get<double>() - 1.0;
    };
    CHECK(roughness(simulation) < 0.01);
    CHECK(roughness(simulation) < 0.25 * roughness(planning));
    CHECK(simulation["volume"].get<double>() ==
          Approx(planning["volume"].get<double>()).epsilon(0.01));
}

SCENARIO("A model for planning keeps its distance to a neighbour", "[workbench][prepare]") {
    static const std::string tumour = phantom("tumour");
    const std::string mask = tumour + "/mask.nii.gz", neighbour = tumour + "/neighbour.vtp";
    const double exact = least_distance(read_surface(tumour + "/exact.vtp").surface,
                                        read_surface(neighbour).surface);  // [mm]
    GIVEN("a mask") {
        static const Beginning beginning([&](const std::string& folder) {
            return prepared(mask, "planning", folder + "/planned", {"--neighbour", neighbour});
        });
        const Json& report = beginning.again();
        const std::string out = beginning.folder() + "/planned";
        THEN("the report says how near it comes, within a quarter of a voxel of the truth") {
            const double found = report["neighbours"]["neighbour"]["distance_mm"];
            CHECK(std::abs(found - exact) < 0.25 * 0.453);
            CHECK(report["neighbours"]["neighbour"]["place_mm"].size() == 3);
            CHECK_THAT(file_content(out + "/report.html"), Contains("<h2>Neighbours</h2>"));
        }
        THEN("--resume with the same neighbour makes no edit twice") {
            const auto edits = [&] {
                return Json::parse(run({"log", out + "/project.vbench", "--json"}).out)["edits"]
                    .size();
            };
            const std::size_t made = edits();
            prepared(mask, "planning", out, {"--neighbour", neighbour, "--resume"});
            CHECK(edits() == made);
            AND_THEN("another one is loaded beside it") {
                const Json more = prepared(mask, "planning", out,
                                           {"--neighbour", tumour + "/exact.vtp", "--resume"});
                CHECK(edits() == made + 1);
                CHECK(more["neighbours"]["exact"]["distance_mm"] == Approx(0.0).margin(0.5));
                CHECK(more["neighbours"].contains("neighbour"));
            }
        }
    }
    GIVEN("a mask whose staircases are smoothed") {
        const Json report =
            prepared(mask, "planning", temporary_folder() + "/planned",
                     {"--neighbour", neighbour, "--set", "extract-surface.mask_surface=midway"});
        THEN("smoothing is aware of the distance and keeps it") {
            const Json& steps = report["steps"];
            const auto smooth = std::ranges::find_if(
                steps, [](const Json& step) { return step["operation"] == "smooth"; });
            REQUIRE(smooth != steps.end());
            CHECK((*smooth)["resolved"]["distance"] == "linear");
            const Json& figures = (*smooth)["report"];
            CHECK(figures["smallest_neighbour_distance_after_mm"].get<double>() ==
                  Approx(figures["smallest_neighbour_distance_mm"].get<double>()).margin(1e-6));
        }
    }
}

SCENARIO("A label map's other labels are neighbours", "[workbench][prepare]") {
    static const std::string mask = phantom("tumour") + "/mask.nii.gz";
    static const Beginning beginning([](const std::string& folder) {
        return prepared(mask, "planning", folder + "/labelled", {"--neighbour", "1"});
    });
    const Json& report = beginning.again();
    const std::string out = beginning.folder() + "/labelled";
    CHECK(report["neighbours"]["label-1"]["distance_mm"] == Approx(0.0).margin(0.05));  // itself
    THEN("a surface has none") {
        const ProgramRun result = run({"prepare", out + "/surface.stl", "--for", "planning",
                                       "--neighbour", "1", "--out", out + "-2"});
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, Contains("labels need a label map"));
    }
    THEN("a file that does not exist is an error") {
        const ProgramRun result = run({"prepare", mask, "--for", "planning", "--neighbour",
                                       out + "/absent.stl", "--out", out + "-3"});
        CHECK(result.exit_code == 3);
        CHECK_THAT(result.err, Contains("the neighbour 'absent.stl' does not exist"));
        CHECK(names_in(out + "-3").empty());
    }
}

SCENARIO("One project holds a model for flow and one for printing", "[workbench][prepare]") {
    static const Beginning beginning([](const std::string& folder) {
        const std::string tube = folder + "/tube.stl", both = folder + "/both";
        write_surface(closed_tube(2.0, 20.0, 32, 40), tube);
        const Json flow = prepared(tube, "cfd", both, {"--units", "mm"});
        const Json before = edits_in(both + "/project.vbench");
        const Json print = prepared(tube, "rp", both, {"--units", "mm", "--resume"});
        return std::tuple(flow, before, print, edits_in(both + "/project.vbench"));
    });
    const auto& [flow, before, print, now] = beginning.again();
    const std::string file = beginning.folder() + "/tube.stl", out = beginning.folder() + "/both";
    const std::string project = out + "/project.vbench";
    THEN("the folder has the products of both") {
        const Names names = names_in(out);
        for (const char* name : {"openfoam", "volume.vtu", "print.stl", "print.3mf"})
            CHECK(std::ranges::count(names, name) == 1);
        CHECK(print["purpose"] == "rp");
    }
    THEN("the model for flow is as it was") {
        for (const Json& edit : before) {
            CAPTURE(edit.dump());
            CHECK(std::ranges::count(now, edit) == 1);
        }
        CHECK(exported_volume(project, "cfd") ==
              Approx(flow["quality"]["after"]["volume"].get<double>()));
    }
    THEN("the print has edits of its own in the steps that are not shared, and no extensions") {
        for (const Json& step : print["steps"]) {
            CAPTURE(step.dump());
            const bool shared = step["step"] == "source";
            CHECK(step["variant"] == (shared ? "" : "rp"));
            CHECK(step["operation"] != "extrude-opening");
            if (shared)
                CHECK(std::ranges::count(before, step["edit"],
                                         [](const Json& edit) { return edit["edit"]; }) == 1);
        }
        CHECK(length_of(print) < 20.5);
        CHECK(length_of(flow) > length_of(print) + 2.0);
        CHECK_THAT(print["warnings"].dump(), Contains("is shared with cfd and kept: preset=cfd"));
    }
    THEN("neither lacks anything") {
        for (const std::string purpose : {"cfd", "rp"}) {
            const ProgramRun again =
                run({"prepare", file, "--units", "mm", "--for", purpose, "--out", out, "--resume"});
            INFO(again.err);
            CHECK(again.exit_code == 0);
            CHECK_THAT(again.err, Contains("every edit of the recipe has been made"));
        }
        CHECK(edits_in(project) == now);
    }
}

SCENARIO("A model that was undone does not stand in the way of another purpose",
         "[workbench][prepare]") {
    const std::string out = temporary_folder() + "/undone", input = phantom("tube");
    static_cast<void>(prepared(input, "planning", out));
    const auto edits = [&] {
        return Json::parse(run({"log", out + "/project.vbench", "--json"}).out)["edits"].size();
    };
    while (edits() > 1) REQUIRE(run({"undo", out + "/project.vbench"}).exit_code == 0);
    const Json report = prepared(input, "rp", out, {"--resume"});
    CHECK(report["purpose"] == "rp");
    for (const Json& step : report["steps"])
        CHECK((step["operation"] != "repair" || step["step"] == "source"));
}

SCENARIO("What a purpose lacks in shared steps is made in its own", "[workbench][prepare]") {
    static const Beginning beginning([](const std::string& folder) {
        write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.stl");
        write_text(folder + "/recipe.json", R"([
            {"operation": "repair"},
            {"operation": "smooth", "step": "source", "arguments": {"iterations": 3}},
            {"operation": "smooth", "step": "source", "arguments": {"iterations": 8},
             "when": "simulation"}])");
        const Json report = prepared(folder + "/tube.stl", "planning", folder + "/both",
                                     {"--units", "mm", "--recipe", folder + "/recipe.json"});
        CHECK(edits_in(folder + "/both/project.vbench").size() == 3);
        return report["quality"]["after"]["volume"].get<double>();
    });
    const double planned = beginning.again();
    const std::string folder = beginning.folder(), file = folder + "/tube.stl";
    const std::string out = folder + "/both", project = out + "/project.vbench";
    const std::vector<std::string> resuming = {"--units", "mm", "--recipe", folder + "/recipe.json",
                                               "--resume"};
    THEN("the model made by shared steps alone stays as it is") {
        prepared(file, "simulation", out, resuming);
        const Json edits = edits_in(project);
        REQUIRE(edits.size() == 4);
        CHECK(edits[3]["step"] == "openings");
        CHECK(edits[3]["variant"] == "simulation");
        CHECK(edits[3]["given"]["iterations"] == 8);
        CHECK(exported_volume(project, "planning") == Approx(planned));
        CHECK(exported_volume(project, "simulation") != Approx(planned).epsilon(1e-6));
        prepared(file, "simulation", out, resuming);
        CHECK(edits_in(project) == edits);
    }
    THEN("an edit that only a shared step can hold is refused") {
        write_text(folder + "/recipe.json",
                   R"([{"operation": "repair"}, {"operation": "keep-component"}])");
        const ProgramRun refused =
            run({"prepare", file, "--units", "mm", "--for", "simulation", "--recipe",
                 folder + "/recipe.json", "--out", out, "--resume"});
        CHECK(refused.exit_code == 2);
        CHECK_THAT(refused.err, Contains("keep-component is missing in step source, which is "
                                         "shared with planning"));
        CHECK(edits_in(project).size() == 3);
    }
    THEN("an edit by hand is of the purpose that was prepared last") {
        REQUIRE(run({"apply", project, "smooth", "iterations=2"}).exit_code == 0);
        CHECK(edits_in(project).back()["variant"] == "planning");
    }
}
