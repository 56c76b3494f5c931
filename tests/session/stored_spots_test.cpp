#include "workbench/session/stored_spots.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/project/database.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

void store_text(const std::string& project, const std::string& text) {
    const Database database(project, OpenMode::Write);
    database.prepare("INSERT OR REPLACE INTO meta VALUES('spots', ?)").bind(0, text).step();
}

}  // namespace

SCENARIO("Spots are kept in a project beside its edits", "[session][spots]") {
    const std::string project = temporary_folder() + "/spots.vbench";
    sphere_session().save_as(project);
    CHECK(stored_spots(project).empty());
    const std::vector<Spot> spots = {
        {.name = "bump \"1\"", .point = Vec3(0.1, -2.0 / 3.0, 1e-9), .normal = Vec3::UnitZ()},
        {.name = "", .point = Vec3(1, 2, 3)}};
    store_spots(project, spots);
    CHECK(stored_spots(project) == spots);
    THEN("others replace them") {
        store_spots(project, {spots[1]});
        CHECK(stored_spots(project) == std::vector{spots[1]});
    }
    THEN("a name that is no text in UTF-8 is kept as far as it is") {
        store_spots(project, {{.name = "a\xFF"}});
        CHECK_THAT(stored_spots(project).front().name, Contains("a"));
    }
    THEN("what is not a list of spots is refused") {
        for (const char* text : {"{}", "[1]", R"([{"name": "a"}])", "[",
                                 R"([{"name": 1, "point": [0,0,0], "normal": [0,0,1]}])",
                                 R"([{"name": "a", "point": [0,0], "normal": [0,0,1]}])",
                                 R"([{"name": "a", "point": [0,0,0], "normal": [0,0,0]}])"}) {
            INFO(text);
            store_text(project, text);
            CHECK_THROWS_AS(stored_spots(project), InvalidInput);
        }
    }
}
