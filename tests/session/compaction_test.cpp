#include "workbench/session/compaction.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Arguments bump_of(double height) {
    return {{"at", kTop}, {"reach", 4.0}, {"height", height}};
}

}  // namespace

SCENARIO("Compacting drops what the current state does not need, and no edit",
         "[session][compaction]") {
    const std::string file = temporary_folder() + "/c.vbench";
    double kept = 0.0, undone = 0.0;
    StateId there = 0;
    std::size_t states = 0;
    {
        Session session = sphere_session();
        for (int i = 0; i < 5; ++i) session.apply("bump", bump_of(0.5 + 0.1 * i));
        undone = top_of(session.scene());
        there = session.snapshot()->history->current();
        for (int i = 0; i < 5; ++i) session.undo();
        session.apply("bump", bump_of(0.25));
        kept = top_of(session.scene());
        states = session.snapshot()->history->states().size();
        session.save_as(file);
    }
    const Compaction done = compact_project(file);
    CHECK(done.dropped == std::map<std::string, std::size_t>{{"bump", 5}});
    CHECK(done.after < done.before);
    Session session = Session::open(file, options());
    CHECK(session.snapshot()->history->states().size() == states);
    CHECK(top_of(session.scene()) == kept);
    WHEN("one goes to the undone edits") {
        session.jump(there);
        THEN("they are pending, and run again with the same result") {
            CHECK(session.log().back().status == EditStatus::Pending);
            CHECK(top_of(session.scene()) == undone);
            CHECK(session.log().back().status == EditStatus::Done);
        }
    }
    WHEN("it is done again") {
        session = Session::create(temporary_folder() + "/other.vbench", options());
        CHECK(compact_project(file).dropped.empty());
    }
    WHEN("another program holds the project") {
        CHECK_THROWS_AS(compact_project(file), IoError);
    }
}
