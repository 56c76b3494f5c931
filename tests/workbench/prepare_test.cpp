#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <sstream>
#include <thread>
#include <tuple>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "tests/support/beginning.h"
#include "tests/support/child_process.h"
#include "tests/support/image_shapes.h"
#include "tests/support/iso_surface.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/export/export_formats.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/model_check.h"
#include "workbench/review/provenance.h"
#include "workbench/review/review.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The tube phantom as a case folder, made once.
const std::string& tube() {
    static const std::string folder = [] {
        const std::string made = temporary_folder() + "/tube";
        REQUIRE(run({"phantom", "tube", "--out", made}).exit_code == 0);
        return made;
    }();
    return folder;
}

Surface wavy_sheet(int cells) {
    Positions points;
    std::vector<Triangle> triangles;
    const auto at = [&](int i, int j) { return static_cast<VertexId>(i * (cells + 1) + j); };
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) {
            points.emplace_back(i, j, 0.1 * std::sin(i));
            if (i == cells || j == cells) continue;
            triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return make_surface(std::move(points), std::move(triangles));
}

/// The options of prepare that an error names: "`--resume --set a.b=c` goes on".
std::vector<std::string> options_in(const std::string& error) {
    std::smatch found;
    REQUIRE(std::regex_search(error, found, std::regex("`(--resume [^`]+)`")));
    std::istringstream words(found[1]);
    return {std::istream_iterator<std::string>(words), {}};
}

/// Runs the command that an error names: "`vesselbench change out/project.vbench 4 edge=0.3`,
/// then".
ProgramRun followed(const std::string& error) {
    std::smatch found;
    REQUIRE(std::regex_search(error, found, std::regex("\n`vesselbench (.+)`, then --resume")));
    std::istringstream words(found[1]);
    std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
    return run(command);
}

void check_bad_input(const ProgramRun& result) {
    INFO(result.err);
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.err, Contains("vesselbench: "));
    CHECK(result.out.empty());
}

}  // namespace

SCENARIO("An organ is printed whole", "[workbench][prepare][data]") {
    const std::string labels = shared_data("images/totalseg_example_labels_117.nii.gz");
    if (labels.empty()) return;
    const fs::path out = fs::path(temporary_folder()) / "liver";
    const ProgramRun result = run({"prepare", labels, "--for", "rp", "--set",
                                   "extract-surface.labels=5", "--out", out.string()});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const double printed = volume(read_surface((out / "print.stl").string()).surface);
    CHECK(printed == Approx(1.013e6).epsilon(0.02));  // of the mask [mm^3]
}

SCENARIO("A mask's surface has no staircases to smooth", "[workbench][prepare]") {
    const std::string mask = tube() + "/mask.nii.gz", out = temporary_folder() + "/mask";
    const auto operations = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"prepare", mask, "--for", "rp", "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun result = run(words);
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        std::vector<std::string> names;
        const Json log = Json::parse(run({"log", out + "/project.vbench", "--json"}).out);
        for (const Json& edit : log["edits"])
            if (edit["step"] == "source") names.push_back(edit["operation"]);
        return names;
    };
    THEN("prepare finds where it bends least and does not smooth it") {
        CHECK(operations({}) == Names{"load-image", "extract-surface", "repair", "widen"});
        AND_THEN("--resume finds nothing missing") {
            CHECK(operations({"--resume"}) ==
                  Names{"load-image", "extract-surface", "repair", "widen"});
        }
    }
    THEN("the surface midway between voxels is smoothed as before") {
        CHECK(operations({"--set", "extract-surface.mask_surface=midway"}) ==
              Names{"load-image", "extract-surface", "repair", "smooth", "widen"});
    }
}

SCENARIO("A model that has lost a vessel is an error", "[workbench][prepare]") {
    const Surface tube = closed_tube(2.0, 30.0, 40, 90), half = closed_tube(2.0, 12.0, 40, 90);
    CHECK(compared_vessels({tube, {}}, closed_tube(2.0, 29.0, 40, 90)).lost.empty());
    const VesselCheck check = compared_vessels({tube, {}}, half);
    REQUIRE(check.lost.size() == 1);
    CHECK(check.lost[0].diameter == Approx(4.0).epsilon(0.05));
    CHECK(check.lost[0].tip.z() > 28.0);
    THEN("not if it was cut off there as asked") {
        CHECK(compared_vessels({tube, {{tube, half}}}, half).lost.empty());
        CHECK(compared_vessels({tube, {{half, half}}}, half).lost.size() == 1);
    }
    THEN("where vessels cannot be looked for, a warning says so") {
        const Surface nothing =
            make_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {Triangle{0, 1, 2}});
        const auto warning = compared_vessels({nothing, {}}, half).warning;
        REQUIRE(warning);
        CHECK(warning->code == "vessels-not-compared");
    }
}

SCENARIO("What has no vessel in it is refused", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    const auto prepared = [&](const std::string& name, const std::string& purpose) {
        return run(
            {"prepare", folder + "/" + name, "--units", "mm", "--for", purpose, "--out", out});
    };
    GIVEN("a ball and a box of fine triangles") {
        write_surface(icosphere(10.0, 4), folder + "/ball.stl");
        const Vec3 corner = Vec3::Constant(-10.0);
        const auto flat = [&](const Vec3& p) { return p.cwiseAbs().maxCoeff() - 9.0; };
        write_surface(iso_surface(flat, {corner, -corner}, 1.0), folder + "/box.stl");
        for (const char* name : {"ball.stl", "box.stl"}) {
            CAPTURE(name);
            const ProgramRun flow = prepared(name, "cfd");
            CHECK(flow.exit_code == 1);
            CHECK_THAT(flow.err, Contains("there is no vessel in it"));
            AND_THEN("a print shows it as it is") {
                const ProgramRun print = prepared(name, "rp");
                CHECK(print.exit_code == 0);
                CHECK_THAT(print.err,
                           Contains("clip-opening: the step was skipped: there is no vessel"));
            }
        }
    }
    GIVEN("a wavy sheet, and an image of noise") {
        write_surface(wavy_sheet(40), folder + "/sheet.stl");
        std::mt19937 random(1);
        const auto value = [&](const Vec3&) { return static_cast<double>(random() % 200); };
        write_image(folder + "/noise.nrrd",
                    image_of({40, 40, 40}, Eigen::Matrix4d::Identity(), value));
        for (const auto& [name, why] :
             {std::pair("sheet.stl", "sheet"), std::pair("noise.nrrd", "noise")}) {
            CAPTURE(name);
            const ProgramRun result = prepared(name, "cfd");
            CHECK(result.exit_code == 3);
            CHECK_THAT(result.err, Contains("no vessel in it") && Contains(why));
            CHECK_FALSE(fs::exists(out));
        }
    }
}

SCENARIO("A vessel that an edit loses ends prepare with an error", "[workbench][prepare]") {
    const auto side = [](const Vec3& p) {
        return std::min(capsule(p, Vec3(0, 0, -18), Vec3(0, 0, 18), 3.0),
                        capsule(p, Vec3::Zero(), Vec3(16, 0, 0), 1.2));
    };
    const auto prepared_in = [](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> command = {
            "prepare",  folder + "/side.stl",    "--units", "mm",           "--for", "cfd",
            "--recipe", folder + "/recipe.json", "--out",   folder + "/out"};
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    };
    static const Beginning beginning([&](const std::string& folder) {
        const Surface whole = iso_surface(side, {Vec3(-5, -5, -23), Vec3(19, 5, 23)}, 0.4);
        std::vector<Triangle> open;  // at both ends of the trunk: the side branch stays closed
        for (const Triangle& t : whole.triangles())
            if (std::abs(whole.points()[t[0]].z()) < 17.0) open.push_back(t);
        write_surface(make_surface(whole.points(), open), folder + "/side.stl");
        write_text(folder + "/recipe.json", R"([
            {"operation": "repair"},
            {"operation": "clip-opening", "arguments": {"closed": [17, 0, 0]}},
            {"operation": "remesh", "arguments": {"mode": "uniform", "edge": 3.0}},
            {"operation": "tetrahedralize"}])");
        return prepared_in(folder, {});
    });
    const ProgramRun& result = beginning.again();
    const std::string& folder = beginning.folder();
    const auto prepared = [&](const std::vector<std::string>& more) {
        return prepared_in(folder, more);
    };
    INFO(result.err);
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Contains("the model has lost vessels:") && Contains("diameter 2.") &&
                               Contains("lost by edit 4, remesh:"));
    CHECK(names_in(folder + "/out") == Names{"project.vbench", "report.json"});
    THEN("before a volume mesh is made of it") {
        const Json log = Json::parse(run({"log", folder + "/out/project.vbench", "--json"}).out);
        CHECK(log["edits"].back()["operation"] == "remesh");
        AND_THEN("also of pending edits") {
            REQUIRE(run({"apply", folder + "/out/project.vbench", "tetrahedralize"}).exit_code ==
                    0);
            REQUIRE(run({"change", folder + "/out/project.vbench", "2", "caps=false"}).exit_code ==
                    0);
            const ProgramRun again = prepared({"--resume"});
            CHECK(again.exit_code == 1);
            CHECK_THAT(again.err, Contains("remeshing: remesh (") &&
                                      !Contains("tetrahedralize (") &&
                                      Contains("the model has lost vessels:"));
        }
    }
    THEN("it stays one after a cut by hand, which takes away what lies beyond it only") {
        const std::string project = folder + "/out/project.vbench";
        REQUIRE(run({"apply", project, "clip-opening", "tip=0,0,17", "distance=4"}).exit_code == 0);
        const ProgramRun again = prepared({"--resume"});
        INFO(again.err);
        CHECK(again.exit_code == 1);
        CHECK_THAT(again.err, Contains("the model has lost vessels:"));
    }
    THEN("the command in its text mends it") {
        CHECK(followed(result.err).exit_code == 0);
        const ProgramRun again = prepared({"--resume"});
        INFO(again.err);
        CHECK(again.exit_code == 0);
        CHECK(Json::parse(text_of(folder + "/out/report.json"))["openings"].size() == 2);
    }
    THEN("a distance for all cuts does not hide it") {
        const ProgramRun other = prepared({"--set", "clip-opening.distance=3"});
        INFO(other.err);
        CHECK(other.exit_code == 1);
        CHECK_THAT(other.err, Contains("the model has lost vessels:"));
    }
}

SCENARIO("An end that should be open ends prepare with a command that goes on",
         "[workbench][prepare]") {
    // What a trunk or an aneurysm may be, beside two flat ends.
    const auto body = [](const Vec3& p) {
        const double vessels = std::min({capsule(p, Vec3(0, 0, -18), Vec3(0, 0, 18), 1.6),
                                         capsule(p, Vec3::Zero(), Vec3(6, 0, 0), 2.0)});
        return std::max(vessels, std::abs(p.z()) - 15.0);
    };
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(iso_surface(body, {Vec3(-5, -5, -16), Vec3(11, 5, 16)}, 0.3),
                  folder + "/trunk.stl");
    write_text(folder + "/recipe.json",
               R"([{"operation": "repair"}, {"operation": "clip-opening"}])");
    const auto prepared = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command = {
            "prepare",  folder + "/trunk.stl",  "--units", "mm", "--for", "planning", "--out", out,
            "--recipe", folder + "/recipe.json"};
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    };
    const ProgramRun stopped = prepared({"--json"});
    INFO(stopped.err);
    REQUIRE(stopped.exit_code == 1);
    std::size_t listed = 0;
    for (std::size_t at = 0; (at = stopped.err.find("\n  ", at)) != std::string::npos; ++at)
        ++listed;
    CHECK(listed == 3);
    CHECK_THAT(stopped.err, Contains("it is not certain that end ") && Contains("% likely"));
    const Json diagnostics = Json::parse(text_of(out + "/report.json"))["stopped"]["diagnostics"];
    REQUIRE_FALSE(diagnostics.empty());
    CHECK(diagnostics[0]["code"] == "end-in-doubt");
    const Json& remedies = diagnostics[0]["remedies"];
    REQUIRE(remedies.size() == 2);
    CHECK_THAT(remedies[0]["commands"].dump(),
               Contains("clip-opening.open_ends=") || Contains("clip-opening.close_ends="));
    CHECK(remedies[1]["commands"][0].back() == "clip-opening.accept_doubts=true");
    const Json printed = Json::parse(stopped.out)["diagnostics"];
    REQUIRE(printed.size() == diagnostics.size());
    CHECK(printed[0]["place_mm"] == diagnostics[0]["place_mm"]);
    CHECK(printed[0]["figures"] == diagnostics[0]["figures"]);
    CHECK(printed[0]["remedies"][0]["operation"] == "clip-opening");
    CHECK(printed[0]["remedies"][1]["arguments"]["accept_doubts"] == "true");
    const std::vector<std::string> way_on = options_in(stopped.err);
    REQUIRE(way_on.size() >= 3);
    const ProgramRun resumed = prepared(way_on);
    INFO(resumed.err);
    CHECK(resumed.exit_code == 0);
    const std::string number = std::to_string(diagnostics[0]["figures"]["number"].get<int>());
    const ProgramRun opened = prepared({"--open", number, "--inlet", number});
    INFO(opened.err);
    CHECK(opened.exit_code == 0);
    CHECK(Json::parse(text_of(out + "/report.json"))["openings"].size() == 3);
}

SCENARIO("An opening in a vessel's side ends prepare with a command that mends it",
         "[workbench][prepare]") {
    const auto bow = [](const Vec3& p) {
        const double along = p.z() > 0.0 ? std::hypot(p.x(), p.z()) : std::abs(p.x());
        return std::max(std::hypot(along - 8.0, p.y()) - 2.0, -12.1 - p.z());
    };
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(iso_surface(bow, {Vec3(-12, -4, -14), Vec3(12, 4, 12)}, 0.4),
                  folder + "/bow.stl");
    write_text(folder + "/recipe.json",
               R"([{"operation": "repair"}, {"operation": "clip-opening"}])");
    const auto prepared = [&](const std::string& more) {
        return run({"prepare", folder + "/bow.stl", "--units", "mm", "--for", "planning", "--out",
                    out, "--recipe", folder + "/recipe.json", more});
    };
    REQUIRE(prepared("--set=clip-opening.strict=false").exit_code == 0);
    REQUIRE(run({"apply", out + "/project.vbench", "clip-opening", "planes=0,0,10,0,0,9.8,0,0,1,0",
                 "names=outlet:side"})
                .exit_code == 0);
    const ProgramRun stopped = prepared("--resume");
    INFO(stopped.err);
    CHECK(stopped.exit_code == 1);
    CHECK_THAT(stopped.err, Contains("the opening 'side' at (") && Contains("vessel's side"));
    CHECK(followed(stopped.err).exit_code == 0);
    const ProgramRun resumed = prepared("--resume");
    INFO(resumed.err);
    CHECK(resumed.exit_code == 0);
}

SCENARIO("A flow model has layers on its wall where they can be made", "[workbench][prepare]") {
    const auto prepared = [](const std::vector<std::string>& more) {
        const std::string out = temporary_folder() + "/layers";
        std::vector<std::string> words = {"prepare", tube(), "--for", "cfd", "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun made = run(words);
        return std::pair(made, made.exit_code == 0
                                   ? Json::parse(text_of(out + "/report.json"))["volume_mesh"]
                                   : Json());
    };
    const auto [plain, usual] = prepared({});
    REQUIRE(plain.exit_code == 0);
    CHECK(usual["prisms"].get<int>() > 1000);
    CHECK(usual["smallest_scaled_jacobian"].get<double>() >= 0.2);

    const auto [few, without] = prepared({"--set", "tetrahedralize.cells=4000"});
    CHECK(few.exit_code == 0);
    CHECK_THAT(few.err, Contains("layers=0 instead") && Contains("prisms"));
    CHECK_FALSE(without.contains("prisms"));

    const ProgramRun asked =
        prepared({"--set", "tetrahedralize.cells=4000", "--set", "tetrahedralize.layers=4"}).first;
    CHECK(asked.exit_code == 1);
    CHECK_THAT(asked.err, Contains("prisms"));
}

SCENARIO("A phantom becomes a CFD case", "[workbench][prepare]") {
    static const Beginning beginning([](const std::string& folder) {
        return run({"prepare", tube(), "--for", "cfd", "--out", folder + "/cfd", "--json"});
    });
    const ProgramRun& result = beginning.again();
    const std::string out = beginning.folder() + "/cfd";
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(names_in(out) == Names{"openfoam", "project.vbench", "report.html", "report.json",
                                 "surface.stl", "surface.vtp", "volume.msh", "volume.vtu"});
    const Json report = Json::parse(text_of(out + "/report.json"));
    const Json summary = Json::parse(result.out);
    CHECK(summary["products"] == report["products"]);
    CHECK(summary["warnings"] == report["warnings"]);
    CHECK(summary["notes"] == report["notes"]);
    CHECK(report["quality"]["after"]["closed"] == true);
    CHECK(report["quality"]["after"]["self_intersections"] == 0);
    CHECK(report["openings"].size() == 2);
    CHECK(report["openings"][0]["kind"] == "inlet");
    CHECK(report["ends"].size() == 2);
    for (const Json& end : report["ends"]) CHECK(end["opening"].is_string());
    CHECK_THAT(text_of(out + "/report.html"), Contains("<h2>Vessel ends</h2>"));
    // Of the ends that were cut off, too: they are no part of the way from the model.
    CHECK(report["distance_from_source"]["largest_mm"].get<double>() >
          2.0 * report["distance_to_source"]["largest_mm"].get<double>());
    CHECK(report["volume_mesh"]["cells"].get<int>() > 1000);
    CHECK(report["volume_mesh"] == report["steps"].back()["report"]["quality"]);
    CHECK(report["volume_mesh"]["smallest_dihedral_deg"].get<double>() > 5.0);
    CHECK(report["distance_to_exact"]["mean_mm"].get<double>() < 0.1);
    CHECK(report["flow"]["inlets"][0]["reynolds"].get<double>() ==
          Approx(4 * 1000 * 1.2e-6 / (3.14159265 * 4e-3 * 4e-3)).epsilon(0.05));
    THEN("what was written measures as the report says") {
        const Json measured = Json::parse(run({"measure", out + "/surface.vtp", "--json"}).out);
        CHECK(measured["triangles"] == report["quality"]["after"]["triangles"]);
        CHECK(measured["volume"].get<double>() ==
              Approx(report["quality"]["after"]["volume"].get<double>()));
        CHECK(measured["patches"].size() == 3);
    }
    THEN("every step is an edit that can be replayed, undone and redone") {
        const std::string project = out + "/project.vbench";
        const Json log = Json::parse(run({"log", project, "--json"}).out);
        CHECK(log["edits"].size() == report["steps"].size());
        CHECK(run({"undo", project}).exit_code == 0);
        CHECK(Json::parse(run({"log", project, "--json"}).out)["edits"].size() + 1 ==
              log["edits"].size());
        CHECK(run({"redo", project}).exit_code == 0);
        CHECK(Json::parse(run({"log", project, "--json"}).out)["edits"] == log["edits"]);
    }
    THEN("a second run keeps the first one's project") {
        REQUIRE(run({"prepare", tube(), "--for", "cfd", "--out", out}).exit_code == 0);
        CHECK(fs::exists(out + "/project.1.vbench"));
        CHECK(run({"log", out + "/project.1.vbench"}).exit_code == 0);
    }
}

SCENARIO("A model is finer around a place", "[workbench][prepare]") {
    const std::string out = temporary_folder() + "/finer";
    const Vec3 place(6.0, 3.0, 20.0);  // in the middle of the tube
    const ProgramRun made = run({"prepare", tube(), "--for", "printing", "--refine",
                                 "6,3,20:2.5:0.15", "--out", out, "--json"});
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    const Surface surface = read_surface(out + "/surface.vtp").surface;
    const auto mean_edge_at = [&](double nearest, double farthest) {
        double sum = 0.0, count = 0.0;
        for (const auto& [a, b, c] : surface.triangles()) {
            const Vec3& p = surface.points()[a];
            if (const double away = (p - place).norm(); away < nearest || away > farthest) continue;
            sum += (surface.points()[b] - p).norm();
            count += 1.0;
        }
        return sum / count;
    };
    CHECK(mean_edge_at(0.0, 2.3) == Approx(0.15).epsilon(0.25));
    CHECK(mean_edge_at(6.0, 12.0) > 0.3);
    CHECK(Json::parse(text_of(out + "/report.json"))["purpose"] == "rp");
}

SCENARIO("A phantom becomes a print model", "[workbench][prepare]") {
    const std::string out = temporary_folder() + "/rp";
    const ProgramRun result = run({"prepare", tube(), "--for", "rp", "--out", out});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(names_in(out) == Names{"print.3mf", "print.stl", "project.vbench", "report.html",
                                 "report.json", "surface.stl", "surface.vtp"});
    const Json report = Json::parse(text_of(out + "/report.json"));
    CHECK(report["print"].is_object());
    std::string last = "print:       " + report["print"]["headline"].get<std::string>() + "\n";
    CHECK_THAT(result.out, Catch::Matchers::EndsWith(last));
    for (const Json& row : report["requirements"]) {
        const std::string line = "not met:     " + row["requirement"].get<std::string>() + ": " +
                                 row["limit"].get<std::string>();
        CHECK((result.out.find(line) != std::string::npos) == (row["judgement"] == "not met"));
    }
    for (const Json& step : report["steps"]) CHECK(step["operation"] != "extrude-opening");
    CHECK(text_of(out + "/report.html").find("openfoam") == std::string::npos);
    CHECK_THAT(text_of(out + "/report.html"), Contains("Check of the printable model."));
    THEN("an export without a variant's name is of the only one") {
        REQUIRE(run({"export", out + "/project.vbench", out + "/again.stl"}).exit_code == 0);
        CHECK(text_of(out + "/again.stl") == text_of(out + "/print.stl"));
    }
}

SCENARIO("Without OpenGL the report says why it has no pictures", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), file = folder + "/tube.stl";
    const std::string no_driver = "export __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent;";
    write_surface(closed_tube(2.0, 20.0, 16, 20), file);
    if (run({"picture", file, folder + "/a.png"}, no_driver).exit_code == 0)
        return skip("this OpenGL cannot be switched off");
    write_text(folder + "/recipe.json", R"([{"operation": "repair"}])");
    const std::string out = folder + "/out";
    const ProgramRun result = run({"prepare", file, "--units", "mm", "--for", "planning",
                                   "--recipe", folder + "/recipe.json", "--out", out},
                                  no_driver);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(Json::parse(text_of(out + "/report.json"))["warnings"].dump(),
               Contains("the report has no pictures: "));
    CHECK_THAT(text_of(out + "/report.html"), Contains("the report has no pictures: "));
}

SCENARIO("A print model is closed where its end could not be opened", "[workbench][prepare]") {
    const Surface ball = icosphere(5.0, 4);
    std::vector<Triangle> bowl;
    for (const Triangle& t : ball.triangles())
        if (ball.points()[t[0]].z() < 0.5) bowl.push_back(t);
    const std::string folder = temporary_folder();
    write_surface(make_surface(ball.points(), bowl), folder + "/bowl.stl");
    const std::string out = folder + "/rp";
    const ProgramRun result =
        run({"prepare", folder + "/bowl.stl", "--units", "mm", "--for", "rp", "--out", out});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.err, Contains("clip-opening: the step was skipped") && Contains("fill-hole"));
    const ProgramRun measured = run({"measure", out + "/print.stl", "--json"});
    CHECK(Json::parse(measured.out)["closed"] == true);
}

SCENARIO("prepare goes on where it stopped", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.stl");
    const std::vector<std::string> command = {
        "prepare", folder + "/tube.stl", "--units", "mm", "--for", "cfd", "--out", out};
    auto coarse = command;
    coarse.insert(coarse.end(), {"--set", "remesh.edge=20"});
    const ProgramRun stopped = run(coarse);
    REQUIRE(stopped.exit_code == 1);
    CHECK_THAT(stopped.err, Contains("--resume"));
    REQUIRE(run({"apply", out + "/project.vbench", "smooth", "iterations=2"}).exit_code == 0);
    auto again = command;
    again.emplace_back("--resume");
    const ProgramRun resumed = run(again);
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK_THAT(resumed.err, !Contains("load-surface") && !Contains("clip-opening") &&
                                Contains("remesh") && Contains("tetrahedralize"));
    const Names made = names_in(out);
    CHECK(std::ranges::count(made, "openfoam") == 1);
    CHECK(std::ranges::count(made, "project.1.vbench") == 0);
}

SCENARIO("prepare opens the ends that an edit by hand has not opened", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    const auto fork = [](const Vec3& p) {
        return std::min({capsule(p, Vec3(0, 0, -18), Vec3::Zero(), 2.5),
                         capsule(p, Vec3::Zero(), Vec3(8, 0, 16), 2.0),
                         capsule(p, Vec3::Zero(), Vec3(-8, 0, 16), 2.0)});
    };
    write_surface(iso_surface(fork, {Vec3(-12, -5, -22), Vec3(12, 5, 20)}, 0.5),
                  folder + "/fork.stl");
    write_text(folder + "/recipe.json", R"([
        {"operation": "repair"}, {"operation": "clip-opening"},
        {"operation": "smooth", "arguments": {"iterations": 3}},
        {"operation": "remesh"}, {"operation": "tetrahedralize"}])");
    const auto prepared = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command = {
            "prepare",  folder + "/fork.stl",   "--units", "mm", "--for", "cfd", "--out", out,
            "--recipe", folder + "/recipe.json"};
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    };
    // No end is at the inlet that is asked for.
    REQUIRE(prepared({"--set", "clip-opening.inlet=40,0,0"}).exit_code == 1);
    const std::string project = out + "/project.vbench";
    const auto apply = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"apply", project});
        const ProgramRun made = run(arguments);
        INFO(made.err);
        REQUIRE(made.exit_code == 0);
    };
    apply({"clip-opening", "tip=8,0,16"});
    apply({"smooth", "iterations=2"});
    const ProgramRun resumed = prepared({"--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK_THAT(resumed.err, Contains("clip-opening"));
    Names smoothed;
    const Json log = Json::parse(run({"log", project, "--json"}).out);
    for (const Json& edit : log["edits"])
        if (edit["operation"] == "smooth") smoothed.push_back(edit["given"].dump());
    CHECK(smoothed == Names{R"({"iterations":2})"});  // the one by hand
    CHECK(Json::parse(text_of(out + "/report.json"))["openings"].size() == 3);
    THEN("what is made already is not made again, nor what was removed by hand") {
        REQUIRE(run({"remove", project, "4"}).exit_code == 0);  // the smoothing by hand
        const ProgramRun again = prepared({"--resume"});
        INFO(again.err);
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, Contains("every edit of the recipe has been made"));
    }
}

SCENARIO("What a resumed preparation runs is told, and its report has all warnings",
         "[workbench][prepare]") {
    const auto knob = [](const Vec3& p) {
        return std::min(capsule(p, Vec3(0, 0, -18), Vec3(0, 0, 18), 2.5),
                        capsule(p, Vec3::Zero(), Vec3(4.5, 0, 0), 1.0));
    };
    const auto report_in = [](const std::string& out) {
        return Json::parse(text_of(out + "/report.json"));
    };
    static const Beginning beginning([&](const std::string& folder) {
        const Surface closed = iso_surface(knob, {Vec3(-5, -5, -23), Vec3(8, 5, 23)}, 0.4);
        std::vector<bool> kept(closed.triangle_count());
        for (TriangleId t = 0; t < kept.size(); ++t)
            kept[t] = std::abs(closed.points()[closed.triangles()[t][0]].z()) < 17.0;
        write_surface(select_triangles(closed, kept), folder + "/knob.stl");
        write_text(folder + "/recipe.json", R"([
            {"operation": "repair"},
            {"operation": "remove-branch", "optional": true, "arguments": {"tip": [0, 0, 16]}},
            {"operation": "clip-opening", "arguments": {"accept_doubts": true}},
            {"operation": "remesh", "arguments": {"mode": "uniform", "edge": 20},
             "otherwise": {"edge": 0.6}}])");
        const std::string out = folder + "/out";
        std::vector<std::string> command = {"prepare",  folder + "/knob.stl",   "--units", "mm",
                                            "--for",    "simulation",           "--out",   out,
                                            "--recipe", folder + "/recipe.json"};
        const ProgramRun first = run(command);
        INFO(first.err);
        REQUIRE(first.exit_code == 0);
        const Json before = report_in(out);
        REQUIRE(run({"change", out + "/project.vbench", "2", "caps=false"}).exit_code == 0);
        command.emplace_back("--resume");
        return std::tuple(first, before, command, run(command));
    });
    const auto& [first, before, again, resumed] = beginning.again();
    const std::string out = beginning.folder() + "/out";
    const auto told = [](const ProgramRun& result, const std::string& operation) {
        std::vector<std::string> warnings;
        std::istringstream lines(result.err);
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("warning: " + operation)) warnings.push_back(line.substr(9));
        return warnings;
    };
    REQUIRE_FALSE(told(first, "clip-opening").empty());
    REQUIRE_FALSE(told(first, "remesh: it was made with edge=0.6 instead").empty());
    REQUIRE_FALSE(told(first, "remove-branch: the step was skipped").empty());
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    for (const char* line : {"openings: clip-opening (", "remeshing: remesh ("})
        CHECK_THAT(resumed.err, Contains(line));
    CHECK(told(resumed, "clip-opening") == told(first, "clip-opening"));
    const Json after = report_in(out);
    for (const Json& warning : before["warnings"]) {
        CAPTURE(warning);
        CHECK(std::ranges::count(after["warnings"], warning) == 1);
    }
    CHECK(after["ends"] == before["ends"]);
    THEN("what was skipped is forgotten when it is made") {
        REQUIRE(run({"apply", out + "/project.vbench", "remove-branch", "tip=5.5,0,0"}).exit_code ==
                0);
        REQUIRE(run(again).exit_code == 0);
        CHECK_THAT(report_in(out)["warnings"].dump(), !Contains("was skipped"));
    }
    THEN("an edit that was removed is not called made") {
        REQUIRE(run({"remove", out + "/project.vbench", "4"}).exit_code == 0);
        const ProgramRun shorter = run(again);
        INFO(shorter.err);
        CHECK_THAT(shorter.err, Contains("except those removed by hand (remesh)"));
    }
}

SCENARIO("A project made by hand is prepared in its folder", "[workbench][prepare]") {
    const std::string out = temporary_folder() + "/head", project = out + "/project.vbench";
    const std::string image = tube() + "/image.nii.gz";
    fs::create_directory(out);
    REQUIRE(run({"new", project, image}).exit_code == 0);
    REQUIRE(run({"apply", project, "crop", "box=-8,-8,5,14,12,25"}).exit_code == 0);
    REQUIRE(run({"apply", project, "extract-surface"}).exit_code == 0);
    const ProgramRun result =
        run({"prepare", image, "--for", "planning", "--out", out, "--resume"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.err, !Contains("extract-surface (") && Contains("repair ("));
    const Json report = Json::parse(text_of(out + "/report.json"));
    CHECK(report["steps"][1]["operation"] == "crop");
    CHECK(report["quality"]["after"]["bounds"][5].get<double>() < 26.0);
}

SCENARIO("A vessel's side is not opened where an image ends", "[workbench][prepare]") {
    // A bow whose legs leave the image below; the border above takes a slice of the bend.
    constexpr double kTop = 8.6, kVoxel = 0.5;
    const auto bow = [](const Vec3& p) {
        const double along = p.z() > 0.0 ? std::hypot(p.x(), p.z()) : std::abs(p.x());
        return 100.0 -
               50.0 * std::clamp((std::hypot(along - 8.0, p.y()) - 2.0) / kVoxel, -2.0, 2.0);
    };
    const std::string folder = temporary_folder(), out = folder + "/out";
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.diagonal().head<3>().setConstant(kVoxel);
    matrix.col(3).head<3>() = Vec3(-12, -4, kTop - 41 * kVoxel);
    write_image(folder + "/bow.nrrd", image_of({49, 17, 42}, matrix, bow));
    write_text(folder + "/recipe.json", R"([
        {"operation": "extract-surface", "arguments": {"threshold": 100}},
        {"operation": "repair"}, {"operation": "clip-opening"}])");
    const auto prepared = [&](const std::string& setting) {
        return run({"prepare", folder + "/bow.nrrd", "--for", "planning", "--recipe",
                    folder + "/recipe.json", "--out", out, "--set", setting});
    };
    const ProgramRun made = prepared("clip-opening.strict=false");
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    const Json openings = Json::parse(text_of(out + "/report.json"))["openings"];
    REQUIRE(openings.size() == 2);
    for (const Json& opening : openings) CHECK(opening["centroid"][2].get<double>() < -10.0);
    THEN("asked for, it is an error that names the end") {
        for (const char* name : {"open", "inlet"}) {
            const ProgramRun asked = prepared("clip-opening." + std::string(name) + "=0,0,8.6");
            INFO(asked.err);
            CHECK(asked.exit_code == 1);
            CHECK_THAT(asked.err, Contains("8.6) mm cannot be opened: it lies in the side of"));
        }
    }
}

SCENARIO("prepare does not go on where it cannot", "[workbench][prepare]") {
    static const Beginning beginning([](const std::string& folder) {
        const std::string out = folder + "/out";
        write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.stl");
        const std::vector<std::string> command = {
            "prepare", folder + "/tube.stl", "--units", "mm", "--out", out};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.begin(), command.begin(), command.end());
            return run(more);
        };
        const ProgramRun none = with({"--resume", "--for", "cfd"});
        CHECK(none.exit_code == 2);
        CHECK_THAT(none.err, Contains("no project.vbench"));
        CHECK_FALSE(fs::exists(out));
        REQUIRE(with({"--for", "simulation"}).exit_code == 0);
        return with({"--resume", "--for", "simulation", "--set", "remesh.edge=0.9"});
    });
    const ProgramRun& refused = beginning.again();
    const std::string folder = beginning.folder(), out = folder + "/out";
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("change " + out + "/project.vbench") && Contains("edge=0.9"));
    THEN("the input is another one, or read in another unit") {
        write_surface(closed_tube(2.5, 20.0, 32, 40), folder + "/other.stl");
        const auto resumed = [&](const std::string& file, const std::string& units) {
            return run({"prepare", folder + file, "--units", units, "--for", "simulation", "--out",
                        out, "--resume"});
        };
        CHECK(resumed("/other.stl", "mm").exit_code == 2);
        CHECK_THAT(resumed("/other.stl", "mm").err, Contains("not made from 'other.stl'"));
        CHECK_THAT(resumed("/tube.stl", "cm").err, Contains("was read in mm, not in cm"));
        CHECK(resumed("/tube.stl", "mm").exit_code == 0);
    }
    THEN("an edit no longer applies after an earlier one was changed") {
        const std::string project = out + "/project.vbench", model = folder + "/model.stl";
        REQUIRE(run({"apply", project, "brush-inflate", "at=2,0,10", "radius=0.5"}).exit_code == 0);
        write_surface(mapped(closed_tube(2.0, 20.0, 32, 40),
                             [](const Vec3& p) { return Vec3(p + Vec3(50, 0, 0)); }),
                      folder + "/far.stl");
        REQUIRE(run({"change", project, "1", "file=" + folder + "/far.stl"}).exit_code == 0);
        const ProgramRun exported = run({"export", project, model});
        CHECK_THAT(exported.err, Contains("no longer applies and is not in the model"));
    }
}

SCENARIO("What is neither a surface nor an image is refused with the formats",
         "[workbench][prepare]") {
    const std::string folder = temporary_folder();
    write_text(folder + "/notes.txt", "a vessel");
    const ProgramRun result =
        run({"prepare", folder + "/notes.txt", "--for", "cfd", "--out", folder + "/out"});
    check_bad_input(result);
    CHECK_THAT(result.err, Contains("neither a surface") && Contains(".stl") && Contains("NIfTI"));
}

SCENARIO("The unit of a prepared case can be changed", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    const std::string project = out + "/project.vbench";
    write_surface(closed_tube(0.2, 2.0, 32, 40), folder + "/tube.stl");  // in cm
    const std::vector<std::string> command = {
        "prepare", folder + "/tube.stl", "--for", "cfd", "--out", out};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), command.begin(), command.end());
        return run(more);
    };
    REQUIRE(with({"--units", "mm", "--set", "openfoam.flow=0.7", "--set",
                  "clip-opening.inlet=0,0,2", "--set", "extrude-opening.length=1"})
                .exit_code == 0);
    const ProgramRun refused = with({"--resume", "--units", "cm"});
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("vesselbench change " + project + " 1 units=cm"));
    // The file is found beside the folder, whatever the current one is.
    const ProgramRun changed = run({"change", project, "1", "units=cm"});
    INFO(changed.err);
    REQUIRE(changed.exit_code == 0);
    CHECK_THAT(changed.out, Contains("clip-opening") && Contains("choose again what") &&
                                Contains("clip-opening were scaled with the model, by 10\n") &&
                                Contains("extrude-opening length=1\n"));
    const ProgramRun resumed = with({"--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK_THAT(resumed.err, Contains("\nflow as before: flow=0.7\n"));
    const Json report = Json::parse(text_of(out + "/report.json"));
    CHECK(report["openings"].size() == 2);
    CHECK(report["openings"][0]["diameter"].get<double>() == Approx(4.0).epsilon(0.05));
    CHECK(report["openings"][0]["kind"] == "inlet");
    CHECK(report["openings"][0]["centroid"][2].get<double>() == Approx(21.0).margin(0.5));
    THEN("the flow is the one that was given") {
        CHECK(report["flow"]["flow_cm3_s"] == 0.7);
        REQUIRE(run({"export", project, folder + "/other"}).exit_code == 0);
        CHECK(text_of(folder + "/other/0/U") == text_of(out + "/openfoam/0/U"));
        REQUIRE(with({"--resume", "--set", "openfoam.density=1050"}).exit_code == 0);
        const Json again = Json::parse(text_of(out + "/report.json"));
        CHECK(again["flow"]["flow_cm3_s"] == 0.7);
        CHECK(again["flow"]["density_kg_m3"] == 1050.0);
    }
}

SCENARIO("prepare replaces nothing but its own products", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.stl");
    const auto prepared = [&](const std::string& input, const std::string& purpose) {
        return run({"prepare", input, "--units", "mm", "--for", purpose, "--out", out});
    };
    REQUIRE(prepared(folder + "/tube.stl", "cfd").exit_code == 0);
    const std::string surface = text_of(out + "/surface.stl");
    CHECK(prepared(out + "/surface.stl", "rp").exit_code == 2);
    CHECK(text_of(out + "/surface.stl") == surface);
    fs::create_directory(out + "/openfoam/100");
    const ProgramRun second = prepared(folder + "/tube.stl", "cfd");
    REQUIRE(second.exit_code == 0);
    CHECK_THAT(second.err, Contains("openfoam was renamed to openfoam.1"));
    CHECK(fs::exists(out + "/openfoam.1/100"));
    CHECK_FALSE(fs::exists(out + "/openfoam/100"));
    const ProgramRun print = prepared(folder + "/tube.stl", "rp");
    REQUIRE(print.exit_code == 0);
    CHECK_THAT(print.err, Contains("openfoam") && Contains("of an earlier preparation"));
}

SCENARIO("An export replaces neither a source nor a folder with other files",
         "[workbench][prepare]") {
    const std::string folder = temporary_folder(), project = folder + "/tube.vbench";
    write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.vtp");
    REQUIRE(run({"new", project, folder + "/tube.vtp", "--units", "mm"}).exit_code == 0);
    const std::string source = text_of(folder + "/tube.vtp");
    REQUIRE(run({"apply", project, "smooth", "iterations=2"}).exit_code == 0);
    check_bad_input(run({"export", project, folder + "/tube.vtp"}));
    CHECK(text_of(folder + "/tube.vtp") == source);
    CHECK(run({"export", project, folder + "/other.vtp"}).exit_code == 0);
    CHECK(run({"export", project, folder + "/other.vtp"}).exit_code == 0);
    for (const std::string& target : {folder, folder + "/", folder + "/."}) {
        check_bad_input(run({"export", project, target}));
        CHECK(fs::exists(project));
    }
    REQUIRE(run({"apply", project, "tetrahedralize"}).exit_code == 0);
    const std::string foam = folder + "/foam";
    REQUIRE(run({"export", project, foam}).exit_code == 0);
    REQUIRE(run({"export", project, foam}).exit_code == 0);
    fs::create_directory(foam + "/100");
    check_bad_input(run({"export", project, foam}));
    CHECK(fs::exists(foam + "/100"));
}

SCENARIO("A phantom does not replace another case", "[workbench][prepare]") {
    const std::string folder = temporary_folder() + "/case";
    REQUIRE(run({"phantom", "tube", "--out", folder}).exit_code == 0);
    CHECK(run({"phantom", "tube", "--out", folder}).exit_code == 0);
    check_bad_input(run({"phantom", "torus", "--out", folder}));
}

SCENARIO("A surface too coarse to be smoothed is no model", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(cube(20.0), folder + "/cube.stl");
    for (const std::string purpose : {"cfd", "rp"}) {
        const ProgramRun result =
            run({"prepare", folder + "/cube.stl", "--units", "mm", "--for", purpose, "--out",
                 out + purpose, "--set", "repair.caps=false"});
        INFO(result.err);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err, Contains("too coarse") && Contains("smooth.iterations=0"));
        CHECK_THAT(run({"log", out + purpose + "/project.vbench"}).out, !Contains("smoothing"));
    }
}

SCENARIO("A coarse surface is smoothed less, which is said", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(closed_tube(2.5, 25.0, 6, 3), folder + "/tube.stl");
    const ProgramRun result = run({"prepare", folder + "/tube.stl", "--units", "mm", "--for", "cfd",
                                   "--out", out, "--set", "repair.caps=false"});
    INFO(result.err);
    CHECK_THAT(result.err,
               Contains("5 iterations would remove") && Contains("1 iteration was made"));
    CHECK_THAT(result.err, !Contains("too coarse"));
}

namespace {

/// The line that exports of a flow model carry.
std::string provenance_of(const std::string& project) {
    const Session session = Session::open(project, {.find = find_operation, .only_reads = true});
    return provenance(session, "cfd", review_of(session, "cfd"));
}

}  // namespace

SCENARIO("A project is created and edited by hand", "[workbench][prepare]") {
    const std::string folder = temporary_folder();
    const std::string project = folder + "/hand.vbench";
    REQUIRE(run({"new", project, tube() + "/exact.vtp"}).exit_code == 0);
    CHECK(run({"new", project, tube() + "/exact.vtp"}).exit_code == 3);
    const ProgramRun smooth =
        run({"apply", project, "smooth", "iterations=3", "--note", "a first look"});
    INFO(smooth.err);
    REQUIRE(smooth.exit_code == 0);
    const ProgramRun log = run({"log", project});
    CHECK_THAT(log.out, Contains("load-surface") && Contains("iterations=3"));
    CHECK(Json::parse(run({"log", project, "--json"}).out)["edits"][1]["note"] == "a first look");
    const ProgramRun replay = run({"replay", project, "--json"});
    CHECK(replay.exit_code == 0);
    CHECK(Json::parse(replay.out)["same"] == true);
    REQUIRE(run({"export", project, folder + "/exact.vtp"}).exit_code == 0);
    const Scene scene{.surface = read_surface(folder + "/exact.vtp").surface};
    const std::string line = provenance_of(project);
    for (const ExportFormat& format : export_formats()) {
        // A page says when it was written, and its title.
        if (format.kind != FormatKind::Surface || format.takes_page) continue;
        const std::string suffix = format.suffixes[0];
        INFO(suffix);
        CHECK(run({"export", project, folder + "/model" + suffix}).exit_code == 0);
        // The writer makes the same bytes of the surface that the exact file holds.
        format.write(scene, folder + "/again" + suffix, {.provenance = line}, {});
        CHECK(text_of(folder + "/model" + suffix) == text_of(folder + "/again" + suffix));
        if (!row_that_reads(surface_formats(), "x" + suffix)) continue;
        const Surface read = read_surface(folder + "/model" + suffix).surface;
        CHECK(read.triangle_count() == scene.surface->triangle_count());
        CHECK(volume(read) == Approx(volume(*scene.surface)).epsilon(1e-4));
    }
    CHECK(run({"export", project, folder + "/model.step"}).exit_code == 2);
    const ProgramRun no_mesh = run({"export", project, folder + "/model.vtu"});
    CHECK(no_mesh.exit_code == 1);  // the input is good, the model lacks something
    CHECK_THAT(no_mesh.err, Contains("tetrahedralize"));
    CHECK_FALSE(fs::exists(folder + "/model.vtu"));
    const ProgramRun nowhere = run({"export", project, folder + "/no-such-folder/model.stl"});
    check_bad_input(nowhere);
    CHECK_THAT(nowhere.err, Contains("its folder 'no-such-folder' does not exist"));
    CHECK_THAT(run({"export", project, folder + "/model.nii.gz"}).err, Contains("'.nii.gz'"));
    CHECK(run({"undo", project}).exit_code == 0);
    CHECK(run({"undo", project}).exit_code == 0);
    CHECK(run({"undo", project}).exit_code == 2);
    CHECK(run({"redo", project, "2"}).exit_code == 0);
}

SCENARIO("Wrong arguments of prepare are rejected before anything is written",
         "[workbench][prepare]") {
    const std::string folder = temporary_folder();
    const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
        arguments.insert(arguments.begin(), "prepare");
        arguments.insert(arguments.end(), {"--out", folder + "/out"});
        const ProgramRun result = run(arguments);
        INFO(result.err);
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, Contains(why));
        CHECK(names_in(folder).empty());
    };
    refused({tube(), "--for", "planing"}, "planning");
    refused({tube(), "--for", "printed"}, "cfd, rp, planning");
    refused({tube(), "--for", "cfd", "--refine", "1,2,3:4"}, "x,y,z:radius:edge");
    refused({tube(), "--for", "cfd", "--refine", "1,2,3:4:-1"}, "edge");
    refused({tube()}, "--for");
    refused({tube(), "--for", "cfd", "--set", "smooth.lamda=1"}, "did you mean 'lambda'");
    refused({tube(), "--for", "cfd", "--set", "openfoam.flow=-1"}, "'flow'");
    refused({tube(), "--for", "rp", "--set", "tetrahedralize.x=1"}, "tetrahedralize");
    refused({tube() + "/exact.vtp", "--for", "cfd", "--mask", tube() + "/mask.nii.gz"}, "--mask");
    refused({tube() + "/exact.vtp", "--for", "cfd", "--units", "inch"}, "units");
    const std::string trunk = temporary_folder() + "/trunk.off";
    write_unitless(open_tube(1.0, 12.0, 24, 40), trunk);
    refused({trunk, "--for", "cfd"}, "in cm it is 123 mm long");
}

SCENARIO("Bad input gives exit code 3 and leaves nothing half-written", "[workbench][bad-input]") {
    const std::string folder = temporary_folder();
    const std::string out = folder + "/out";
    fs::create_directory(folder + "/case");
    write_text(folder + "/case/case.json", "{\"name\": ");
    write_text(folder + "/nan.stl",
               "solid\nfacet normal 0 0 0\nouter loop\nvertex nan 0 0\nvertex 1 0 0\n"
               "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    write_text(folder + "/short.stl", text_of(tube() + "/exact.vtp").substr(0, 300));
    write_text(folder + "/cut.vtp", text_of(tube() + "/exact.vtp").substr(0, 5000));
    write_text(folder + "/cut.nii.gz", text_of(tube() + "/image.nii.gz").substr(0, 5000));
    write_text(folder + "/model.step", "x");
    for (const std::string name :
         {"missing.stl", "case", "nan.stl", "short.stl", "cut.vtp", "cut.nii.gz", "model.step"}) {
        INFO(name);
        const ProgramRun result =
            run({"prepare", folder + "/" + name, "--for", "cfd", "--out", out});
        check_bad_input(result);
        CHECK_FALSE(fs::exists(out));
        check_bad_input(run({"new", folder + "/p.vbench", folder + "/" + name}));
        CHECK_FALSE(fs::exists(folder + "/p.vbench"));
    }
    check_bad_input(run({"prepare", tube(), "--for", "cfd", "--out", folder + "/nan.stl"}));
}

SCENARIO("A full disk leaves nothing half-written", "[workbench][bad-input]") {
    const std::string out = temporary_folder() + "/out";
    const ProgramRun result =
        run({"prepare", tube() + "/exact.vtp", "--for", "rp", "--out", out}, "ulimit -f 700;");
    INFO(result.err);
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.err, Contains("ulimit -f"));
    for (const std::string& name : names_in(out)) CHECK_THAT(name, Contains("project.vbench"));
}

SCENARIO("Each damaged file is prepared, or rejected with a reason", "[workbench][nasty]") {
    const std::string folder = shared_data("nasty");
    if (folder.empty()) return;
    const std::string out = temporary_folder() + "/out";
    const Names hopeless = {"assimp_crash.ply",
                            "assimp_invalid.off",
                            "assimp_malformed.obj",
                            "gc_moebius.obj",
                            "gc_triple_vierbein.obj",
                            "igl_truck.obj",
                            "svmtk_degtri_sliding.off",
                            "trimesh_empty.ply",
                            "trimesh_empty.stl",
                            "trimesh_empty_bin.stl",
                            "trimesh_points_emptyface.ply",
                            "trimesh_soup.stl"};
    for (const std::string& name : hopeless) {
        INFO(name);
        check_bad_input(
            run({"prepare", folder + "/" + name, "--units", "mm", "--for", "rp", "--out", out}));
        CHECK_FALSE(fs::exists(out));
    }
}

SCENARIO("Ctrl-C ends prepare and leaves the project", "[workbench][prepare]") {
    const std::string out = temporary_folder() + "/out";
    ChildProcess program(test::program_path(), {"prepare", tube(), "--for", "cfd", "--out", out});
    const auto edits = [&] {
        const ProgramRun log = run({"log", out + "/project.vbench", "--json"});
        return log.exit_code == 0 ? Json::parse(log.out)["edits"].size() : 0;
    };
    for (int tries = 0; tries < 600 && edits() == 0; ++tries) std::this_thread::sleep_for(20ms);
    program.signal(SIGINT);
    CHECK(program.wait() == 1);
    CHECK(fs::exists(out + "/project.vbench"));
    CHECK_FALSE(fs::exists(out + "/report.json"));
    CHECK(run({"log", out + "/project.vbench"}).exit_code == 0);
}
