#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

ProgramRun program(const std::vector<std::string>& arguments) {
    return run_program(test::program_path(), arguments);
}

/// A noisy ball as a file.
std::string ball_file(const std::string& folder) {
    std::mt19937 random(3);
    std::normal_distribution<double> deviate(0.0, 0.2);
    const Surface ball = mapped(icosphere(10.0, 3), [&](const Vec3& p) {
        return Vec3(p + Vec3(deviate(random), deviate(random), deviate(random)));
    });
    const std::string file = folder + "/ball.vtp";
    write_surface(ball, file);
    return file;
}

std::string text_of(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

SCENARIO("The command line suggests parameters", "[workbench][suggest]") {
    const std::string folder = temporary_folder(), ball = ball_file(folder);
    GIVEN("a surface file") {
        const ProgramRun run = program({"suggest", ball, "--filter", "laplace", "--json"});
        REQUIRE(run.exit_code == 0);
        const Json json = Json::parse(run.out);
        CHECK(json["suggestion"]["tau"] == 0.5);
        CHECK(json["suggestion"]["parameters"]["iterations"] > 0);
        CHECK(json["suggestion"]["curvature_abs_mm"] < json["original"]["curvature_abs_mm"]);
        CHECK(json["suggestion"]["arguments"]["filter"] == "laplace");
        CHECK(json["presets"].size() == 3);
        CHECK(json["presets"][2]["tau"] == 1.0);
    }
    GIVEN("tau 0") {
        const ProgramRun run = program({"suggest", ball, "--filter", "laplace", "--tau", "0"});
        CHECK(run.exit_code == 0);
        CHECK(run.out.find("do not smooth") != std::string::npos);
    }
    GIVEN("the grid and the truth") {
        const std::string truth = folder + "/truth.vtp";
        write_surface(icosphere(10.0, 3), truth);
        const ProgramRun run = program({"suggest", ball, "--filter", "laplace", "--search",
                                        "coarse", "--json", "--grid", "--truth", truth});
        REQUIRE(run.exit_code == 0);
        const Json grid = Json::parse(run.out)["grid"];
        CHECK(grid.size() == 121);
        CHECK(grid[0]["truth_mm"] > 0.05);
    }
    GIVEN("a project") {
        const std::string project = folder + "/ball.vbench";
        REQUIRE(program({"new", project, ball, "--units", "mm"}).exit_code == 0);
        const ProgramRun run = program({"suggest", project, "--filter", "laplace"});
        REQUIRE(run.exit_code == 0);
        const auto at = run.out.find("vesselbench apply ball.vbench smooth filter=laplace");
        CHECK(at != std::string::npos);
    }
    GIVEN("nonsense") {
        CHECK(program({"suggest", ball, "--tau", "2"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--search", "fast"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--score", "best"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--score", "compact"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--operation", "repair"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--operation", "remesh", "min_edge=1"}).exit_code == 2);
        CHECK(program({"suggest", ball, "--operation", "remesh", "--filter", "taubin"}).exit_code ==
              2);
        CHECK(program({"suggest", ball, "lambda=7"}).exit_code == 2);
        CHECK(program({"suggest", folder + "/none.vtp"}).exit_code == 3);
        CHECK(program({"suggest", ball, "--truth", ball}).exit_code == 2);
        CHECK(program({"suggest", ball, "--grid"}).exit_code == 2);
        CHECK(program({"quality", ball}).exit_code == 2);
        CHECK(program({"quality", ball, "--out", folder + "/x.pdf"}).exit_code == 2);
    }
}

SCENARIO("The command line draws model quality graphs and bars", "[workbench][suggest]") {
    const std::string folder = temporary_folder(), ball = ball_file(folder);
    const std::string graphs = folder + "/graphs.svg", bars = folder + "/bars.svg";
    const ProgramRun run = program({"quality", ball, "--filter", "taubin", "--out", graphs, "--out",
                                    bars, "--sort", "measure", "--json"});
    REQUIRE(run.exit_code == 0);
    const std::string text = text_of(graphs);
    for (const char* words : {"lambda [-]", "mu [-]", "iterations", "measure [%]", "curvature"})
        CHECK(text.find(words) != std::string::npos);
    CHECK(text_of(bars).find("volume change, mu") != std::string::npos);
    const Json curves = Json::parse(run.out)["curves"];
    REQUIRE(curves.size() == 3);
    CHECK(curves[2]["parameter"] == "iterations");
    CHECK(curves[2]["points"].size() == 51);
    CHECK(curves[2]["points"][0]["error"] == 0.0);
    CHECK(curves[2]["points"][0]["curvature"] == 1.0);
}

SCENARIO("Parameters of operations that change triangles are suggested", "[workbench][suggest]") {
    const std::string folder = temporary_folder(), ball = ball_file(folder);
    for (const std::string operation : {"remesh", "decimate"}) {
        const ProgramRun run = program({"suggest", ball, "--operation", operation, "--json"});
        REQUIRE(run.exit_code == 0);
        const Json json = Json::parse(run.out);
        INFO(operation << ": more target means fewer triangles at a larger distance");
        const Json &little = json["presets"][0], &much = json["presets"][2];
        CHECK(json["score_form"] == "compact");
        CHECK(much["triangles"] < little["triangles"]);
        CHECK(much["error_mm"] > little["error_mm"]);
        CHECK(json["suggestion"]["terms"].contains("triangles"));
        CHECK(json["suggestion"]["arguments"].contains(operation == "remesh" ? "edge" : "share"));
    }
    WHEN("a rough ball is to be subdivided") {
        const ProgramRun run = program({"suggest", ball, "--operation", "subdivide", "--tau", "1"});
        REQUIRE(run.exit_code == 0);
        CHECK(run.out.find("vesselbench apply PROJECT subdivide iterations=") != std::string::npos);
    }
    WHEN("arguments are given") {
        const ProgramRun run = program({"suggest", ball, "--filter", "taubin", "lambda=0.3",
                                        "mu=-0.31", "iterations=7", "--json"});
        REQUIRE(run.exit_code == 0);
        const Json suggestion = Json::parse(run.out)["suggestion"];
        THEN("they stay") {
            CHECK(suggestion["arguments"]["lambda"] == 0.3);
            CHECK(suggestion["arguments"]["mu"] == -0.31);
            CHECK(suggestion["arguments"]["iterations"] == 7);
        }
    }
    WHEN("any other triangles would be worse") {
        const std::string box = folder + "/box.stl";
        write_surface(cube(10.0), box);
        const ProgramRun run = program({"suggest", box, "--operation", "remesh", "--json"});
        REQUIRE(run.exit_code == 0);
        CHECK(Json::parse(run.out)["suggestion"]["leave_as_is"] == true);
    }
    WHEN("an error decides, and no share") {
        const ProgramRun run = program({"quality", ball, "--operation", "decimate", "max_error=0.1",
                                        "--out", folder + "/bars.svg", "--json"});
        REQUIRE(run.exit_code == 0);
        const Json curve = Json::parse(run.out)["curves"][0];
        THEN("the share that it leads to is the current one") {
            CHECK(curve["parameter"] == "share");
            CHECK(curve["current"] > 0.02);
            CHECK(curve["current"] < 1.0);
        }
    }
    WHEN("a project has variants") {
        const std::string project = folder + "/P";
        REQUIRE(program({"new", project, ball}).exit_code == 0);
        REQUIRE(program({"apply", project, "decimate", "share=0.5", "--variant", "rp"}).exit_code ==
                0);
        const auto vertices = [&](const std::string& variant) {
            const ProgramRun run = program({"suggest", project, "--operation", "decimate",
                                            "--variant", variant, "--search", "coarse"});
            REQUIRE(run.exit_code == 0);
            CHECK((run.out.find("--variant rp") != std::string::npos) == (variant == "rp"));
            CHECK((run.err.find("is a decimate already") != std::string::npos) ==
                  (variant == "rp"));
            return run.out.substr(0, run.out.find("vertices"));
        };
        THEN("each is searched by itself") {
            CHECK(vertices("cfd").find(" 642 ") != std::string::npos);
            CHECK(vertices("rp").find(" 322 ") != std::string::npos);
        }
    }
    WHEN("graphs are drawn") {
        const std::string graphs = folder + "/graphs.svg";
        const ProgramRun run =
            program({"quality", ball, "--operation", "subdivide", "--out", graphs, "--json"});
        REQUIRE(run.exit_code == 0);
        CHECK(text_of(graphs).find("triangles") != std::string::npos);
        const Json json = Json::parse(run.out);
        CHECK(json["scale"]["triangles"] == 1280.0);
        CHECK(json["scale"]["strong"] == "subdivide iterations=3");
        const Json points = json["curves"][0]["points"];
        REQUIRE(points.size() == 4);
        CHECK(points[0]["error"] == 0.0);
        CHECK(points[3]["triangles"] == 64.0);
        CHECK(points[3]["error"] == 1.0);
    }
}

SCENARIO("A search on the GPU suggests what the CPU suggests", "[workbench][suggest][device]") {
    const std::string ball = ball_file(temporary_folder());
    const auto suggest = [&](const std::string& device) {
        const ProgramRun run = program({"suggest", ball, "--filter", "laplace", "--search",
                                        "coarse", "--json", "device=" + device});
        REQUIRE(run.exit_code == 0);
        return Json::parse(run.out);
    };
    const Json cpu = suggest("cpu"), gpu = suggest("gpu");
    CHECK(cpu["device"] == "cpu");
    if (gpu["device"] == "cpu") skip("no OpenGL, the CPU served");
    CHECK(gpu["suggestion"]["score"].get<double>() ==
          Approx(cpu["suggestion"]["score"].get<double>()).epsilon(1e-3));
    CHECK(gpu["suggestion"]["volume_mm3"].get<double>() ==
          Approx(cpu["suggestion"]["volume_mm3"].get<double>()).epsilon(1e-3));
}
