// Which edits belong to a variant, and which to the trunk.

#include <catch2/catch.hpp>
#include <sqlite3.h>

#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const Arguments kBump = {{"at", kTop}, {"reach", 4.0}, {"height", 0.5}};

void run_sql(const std::string& file, const char* sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
    CHECK(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
}

}  // namespace

SCENARIO("Edits of openings and smoothing touch no other variant", "[session][variants]") {
    Session session = sphere_session();
    const double top = top_of(session.scene());
    session.apply("flatten", {}, {.variant = "rp"});
    session.apply("bump", kBump, {.step = Step::Smoothing});
    const auto log = session.log();
    REQUIRE(log.size() == 3);
    CHECK(log[1].edit.place == EditPlace{Step::Openings, "rp"});
    CHECK(log[2].edit.place == EditPlace{Step::Smoothing, "cfd"});
    CHECK(top_of(session.scene("cfd")) == top + 0.5);
    CHECK(top_of(session.scene("rp")) != top + 0.5);
    CHECK(session.log("cfd").size() == 2);
    CHECK(session.log("rp").size() == 2);
    for (const LogEntry& entry : session.log()) CHECK(entry.status == EditStatus::Done);
    THEN("those of earlier steps are shared") {
        session.apply("bump", kBump);
        CHECK(session.log()[1].edit.place == EditPlace{Step::LocalRepair, ""});
        CHECK(top_of(session.scene("cfd")) == top + 1.0);
    }
}

SCENARIO("A project whose trunk has openings keeps smoothing there, too", "[session][variants]") {
    const std::string file = temporary_folder() + "/shared.vbench";
    {
        Session session = Session::create(file, options());
        session.apply("make-sphere", {});
        session.apply("flatten", {});
    }
    run_sql(file, "UPDATE edits SET variant = ''");
    Session session = Session::open(file, options());
    CHECK(session.snapshot()->history->first_variant_step() == Step::Deformation);
    session.apply("bump", kBump, {.step = Step::Smoothing, .variant = "rp"});
    session.apply("scale", {}, {.variant = "rp"});
    CHECK(session.log()[2].edit.place == EditPlace{Step::Smoothing, ""});
    CHECK(session.log()[3].edit.place == EditPlace{Step::Remeshing, "rp"});
    CHECK(top_of(session.scene("rp")) == 2.0 * top_of(session.scene("cfd")));
    THEN("without its edits the steps are the variants'") {
        session.remove_edit(3);
        session.remove_edit(2);
        CHECK(session.snapshot()->history->first_variant_step() == Step::Openings);
    }
}
