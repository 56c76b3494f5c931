#include "workbench/flow/flow_case.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "tests/support/commands.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

constexpr const char* kWhole = "internalField uniform 0;\n// *************** //\n";
constexpr const char* kTorn = "internalField nonuniform 3 ( 1 2 -";

void write_field(const std::string& time, const std::string& name, const char* text) {
    std::filesystem::create_directories(time);
    std::ofstream(time + "/" + name) << text;
}

}  // namespace

SCENARIO("A time of a killed solver counts if all of its fields are whole", "[flow]") {
    const std::string folder = test::temporary_folder();
    for (const char* time : {"/50", "/100"})
        for (const char* field : {"U", "p", "phi", "wallShearStress"})
            write_field(folder + time, field, kWhole);
    CHECK(last_whole_time(folder) == 100.0);
    GIVEN("a torn field that the solver does not start from") {
        write_field(folder + "/100", "wallShearStress", kTorn);
        CHECK(last_whole_time(folder) == 50.0);
        remove_broken_times(folder);
        CHECK_FALSE(std::filesystem::exists(folder + "/100"));
        CHECK(std::filesystem::exists(folder + "/50/U"));
    }
    GIVEN("a field that is missing") {
        std::filesystem::remove(folder + "/100/phi");
        CHECK(last_whole_time(folder) == 50.0);
    }
}
