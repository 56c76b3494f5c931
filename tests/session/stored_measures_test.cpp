#include "workbench/session/stored_measures.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/session/stored_texts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

KeptMeasure distance() {
    return {.name = "neck, \"wide\"",
            .kind = MeasureKind::Distance,
            .points = {Vec3(0, 0, 0), Vec3(3, 4, 0), Vec3(3, 4, 2)},
            .length = 7.0,
            .on = MeasuredOn::AxialSlice,
            .state = 1,
            .variant = "cfd",
            .time = "2024-05-17T09:30:00Z"};
}

KeptMeasure diameter() {
    return {.name = "Diameter 1",
            .kind = MeasureKind::Diameter,
            .points = {Vec3(1, 2, 3), Vec3(2, 2, 3), Vec3(1, 3, 3)},
            .length = 8.0,
            .area = 51.0,
            .equivalent = 8.06};
}

}  // namespace

SCENARIO("Measures are kept in a project beside its edits", "[session][measures]") {
    const std::string project = temporary_folder() + "/measures.vbench";
    sphere_session().save_as(project);
    CHECK(stored_measures(project).empty());
    const std::vector<KeptMeasure> measures = {distance(), diameter()};
    store_measures(project, measures);
    CHECK(stored_measures(project) == measures);
    THEN("undo and new edits leave them") {
        Session session = Session::open(project, options());
        session.undo();
        session.apply("make-sphere", {{"radius", 4.0}});
        CHECK(stored_measures(project) == measures);
    }
    THEN("others replace them") {
        store_measures(project, {});
        CHECK(stored_measures(project).empty());
    }
    THEN("what is not a list of measures is refused") {
        for (const char* text : {"{}", "[1]", "[", R"([{"name": "a"}])"}) {
            INFO(text);
            store_text(project, StoredText::Measures, text);
            CHECK_THROWS_AS(stored_measures(project), InvalidInput);
        }
        KeptMeasure short_one = distance();
        short_one.points.pop_back();
        short_one.points.pop_back();
        store_measures(project, {short_one});
        CHECK_THROWS_AS(stored_measures(project), InvalidInput);
    }
}
