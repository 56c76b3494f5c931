// Veins: a name that says so is asked about, and the flow of a model runs the other way.

#include "workbench/prepare/vessel_question.h"

#include <cmath>
#include <filesystem>
#include <map>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "tests/support/beginning.h"
#include "tests/support/forked_vessel.h"
#include "tests/support/image_shapes.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/prepare/venous_name.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace fs = std::filesystem;

namespace {

Json json_in(const std::string& file) {
    return Json::parse(file_content(file));
}

/// Opens the ends of a forked vessel, and makes nothing else.
ProgramRun cut(const std::string& folder, const std::string& name, Names more) {
    write_surface(forked_vessel(1.5, 1.2), folder + "/" + name);
    write_text(folder + "/cut.json", R"([{"operation": "repair"}, {"operation": "clip-opening"}])");
    Names words = {"prepare",  folder + "/" + name,  "--for",   "planning",
                   "--recipe", folder + "/cut.json", "--units", "mm",
                   "--out",    folder + "/out"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

/// Of the openings, in their order.
Names names_of(const Json& openings) {
    Names names;
    for (const Json& opening : openings) names.push_back(opening["name"]);
    return names;
}

/// The text of a patch in a field of an OpenFOAM case.
std::string patch_in(const std::string& field, const std::string& patch) {
    const auto from = field.find("    " + patch + "\n    {");
    REQUIRE(from != std::string::npos);
    return field.substr(from, field.find("\n    }", from) - from);
}

}  // namespace

SCENARIO("A name is a vein's if one of its words is", "[workbench][vein]") {
    for (const char* name :
         {"vein", "Portal Vein", "portal_vein_and_splenic_vein", "inferior_vena_cava.nii.gz", "IVC",
          "svc_3", "venaCava", "portalvein.stl", "Azygos", "hemiazygos.vtp", "left jugular",
          "sinus sagittalis", "VEIN1"}) {
        CAPTURE(name);
        CHECK(venous_name(name));
    }
    for (const char* name : {"artery", "aorta.stl", "excavation", "veined marble", "Avenal",
                             "patient_0042", "", "aortic sinus", "Sinus of Valsalva",
                             "carotid sinus", "ct_portal_venous_phase.nii.gz", "conduit"}) {
        CAPTURE(name);
        CHECK_FALSE(venous_name(name));
    }
    CHECK(venous_name("Portal Vein")->portal);
    CHECK(venous_name("vena portae")->portal);
    CHECK_FALSE(venous_name("iliac vein")->portal);
    CHECK(venous_name("Left VEIN")->word == "vein");
}

SCENARIO("A surface named like a vein is asked about before anything is made of it",
         "[workbench][vein]") {
    const std::string folder = temporary_folder();
    const ProgramRun asked = cut(folder, "iliac_vein.stl", {});
    CHECK(asked.exit_code == 1);
    CHECK_THAT(asked.err, Contains("the file's name says 'vein'") &&
                              Contains("--set clip-opening.vessel=vein") &&
                              Contains("--set clip-opening.vessel=artery"));
    CHECK_THAT(asked.err, !Contains("repair ("));
    CHECK(json_in(folder + "/out/report.json")["stopped"]["diagnostics"][0]["code"] ==
          "vessel-unstated");
    THEN("the printed answer goes on") {
        const ProgramRun vein =
            cut(folder, "iliac_vein.stl", {"--resume", "--set", "clip-opening.vessel=vein"});
        INFO(vein.err);
        REQUIRE(vein.exit_code == 0);
        CHECK(names_of(json_in(folder + "/out/report.json")["openings"]) ==
              Names{"inlet_1", "inlet_2", "outlet"});
    }
    THEN("it may be an artery") {
        REQUIRE(cut(folder, "iliac_vein.stl", {"--vessel", "artery"}).exit_code == 0);
        CHECK(names_of(json_in(folder + "/out/report.json")["openings"]) ==
              Names{"inlet", "outlet_1", "outlet_2"});
    }
    THEN("where doubts are accepted, it is what the name says, with a warning") {
        const ProgramRun taken = cut(folder, "iliac_vein.stl", {"--accept-doubts"});
        REQUIRE(taken.exit_code == 0);
        CHECK_THAT(taken.err, Contains("the vessel was taken as a vein"));
        const Json report = json_in(folder + "/out/report.json");
        CHECK(names_of(report["openings"]) == Names{"inlet_1", "inlet_2", "outlet"});
        CHECK_THAT(report["warnings"].dump(), Contains("was taken as a vein"));
    }
    THEN("ends says so, and lists them as of an artery") {
        const ProgramRun ends = run({"ends", folder + "/iliac_vein.stl", "--json"});
        CHECK(ends.exit_code == 0);
        CHECK_THAT(ends.err, Contains("the file's name says 'vein'"));
        const ProgramRun vein =
            run({"ends", folder + "/iliac_vein.stl", "--vessel", "vein", "--json"});
        CHECK_THAT(vein.err, !Contains("says 'vein'"));
        std::map<std::string, int> roles;
        const Json listed = Json::parse(vein.out);
        for (const Json& end : listed["ends"])
            if (end["opening"].is_string()) ++roles[end["opening"]];
        CHECK(roles == std::map<std::string, int>{{"inlet", 2}, {"outlet", 1}});
    }
}

SCENARIO("A portal vein distributes its blood, which is said", "[workbench][vein]") {
    const std::string folder = temporary_folder();
    const ProgramRun asked = cut(folder, "PortalVein.stl", {});
    CHECK(asked.exit_code == 1);
    CHECK_THAT(asked.err, Contains("--set clip-opening.vessel=portal"));
    const ProgramRun portal = cut(folder, "PortalVein.stl", {"--vessel", "portal"});
    REQUIRE(portal.exit_code == 0);
    CHECK_THAT(portal.err, Contains("the blood of a portal vein is taken to enter at inlet "));
    CHECK(names_of(json_in(folder + "/out/report.json")["openings"]) ==
          Names{"inlet", "outlet_1", "outlet_2"});
}

SCENARIO("A surface that is not named like a vein is an artery as ever", "[workbench][vein]") {
    const std::string folder = temporary_folder();
    const ProgramRun artery = cut(folder, "fork.stl", {});
    REQUIRE(artery.exit_code == 0);
    const Json report = json_in(folder + "/out/report.json");
    CHECK(names_of(report["openings"]) == Names{"inlet", "outlet_1", "outlet_2"});
    for (const Json& step : report["steps"])
        if (step["operation"] == "clip-opening") CHECK_FALSE(step["resolved"].contains("vessel"));
}

SCENARIO("The chosen label's name says what the vessel is, not the file's", "[workbench][vein]") {
    const std::string folder = temporary_folder();
    const Image grid = ball_image(4.0, 30, Vec3(0.8, 0.8, 0.8));
    const Vec3 middle = middle_of(grid);
    write_image(folder + "/vein.nii.gz",
                image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
                    return (p - middle).norm() < 3.0 ? 1.0 : (p - middle).norm() < 5.0 ? 2.0 : 0.0;
                }));
    write_text(folder + "/vein.txt",
               "0 0 0 0 0 0 0 \"Clear\"\n1 255 0 0 1 1 1 \"artery\"\n"
               "2 0 255 0 1 1 1 \"vena cava\"\n");
    write_text(folder + "/cut.json",
               R"([{"operation": "extract-surface"}, {"operation": "clip-opening"}])");
    const auto with_label = [&](const std::string& label) {
        return run({"prepare", folder + "/vein.nii.gz", "--label", label, "--for", "planning",
                    "--recipe", folder + "/cut.json", "--out", folder + "/" + label});
    };
    CHECK_THAT(with_label("2").err, Contains("the label 'vena cava' says 'vena'"));
    CHECK_THAT(with_label("artery").err, !Contains("says 'vein'"));
}

SCENARIO("A vessel that there is not is refused", "[workbench][vein]") {
    const std::string folder = temporary_folder();
    const ProgramRun option = cut(folder, "fork.stl", {"--vessel", "nonsense"});
    CHECK(option.exit_code == 2);
    CHECK_THAT(option.err, Contains("--vessel") && Contains("nonsense"));
    CHECK(cut(folder, "fork.stl", {"--set", "clip-opening.vessel=nonsense"}).exit_code == 2);
    CHECK_FALSE(fs::exists(folder + "/out"));
}

SCENARIO("The flow case of a vein has an inflow at each inlet, and the pressure at the outlet",
         "[workbench][vein]") {
    static const Beginning beginning([](const std::string& folder) {
        write_surface(forked_vessel(1.5, 1.2), folder + "/fork.stl");
        return run({"prepare", folder + "/fork.stl", "--for", "cfd", "--units", "mm", "--vessel",
                    "vein", "--set", "openfoam.flow=2", "--set", "remesh.edge=0.6", "--out",
                    folder + "/cfd"});
    });
    const ProgramRun& made = beginning.again();
    const std::string out = beginning.folder() + "/cfd";
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    const Json flow = json_in(out + "/report.json")["flow"];
    CHECK(flow["outlets"] == 1);
    CHECK(flow["split"] == "cubes");
    REQUIRE(flow["inlets"].size() == 2);
    const Json &wide = flow["inlets"][0], &thin = flow["inlets"][1];
    const double first = wide["flow_cm3_s"], second = thin["flow_cm3_s"];
    CHECK(first + second == Approx(2.0));
    CHECK(first / second == Approx(std::pow(1.5 / 1.2, 3.0)).epsilon(0.1));
    const std::string u = file_content(out + "/openfoam/0/U"),
                      p = file_content(out + "/openfoam/0/p");
    for (const char* inlet : {"inlet_1", "inlet_2"}) {
        CHECK_THAT(patch_in(u, inlet), Contains("fixedValue"));
        CHECK_THAT(patch_in(p, inlet), Contains("zeroGradient"));
    }
    CHECK_THAT(patch_in(u, "outlet"), Contains("inletOutlet"));
    CHECK_THAT(patch_in(p, "outlet"), Contains("fixedValue"));
    THEN("an export is the same case, and may split the flow by area") {
        const std::string project = out + "/project.vbench";
        REQUIRE(run({"export", project, beginning.folder() + "/again"}).exit_code == 0);
        CHECK(file_content(beginning.folder() + "/again/0/U") == u);
        REQUIRE(
            run({"export", project, beginning.folder() + "/area", "--set", "openfoam.split=area"})
                .exit_code == 0);
        CHECK(file_content(beginning.folder() + "/area/0/U") != u);
    }
    THEN("the edits replay") {
        CHECK(run({"replay", out + "/project.vbench"}).exit_code == 0);
    }
}
