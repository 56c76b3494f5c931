#include "workbench/case/history.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"

using namespace vesselbench;
using Catch::Matchers::Contains;

namespace {

const EditPlace kSource{Step::Source, ""};
const EditPlace kRepair{Step::LocalRepair, ""};
const EditPlace kSmoothing{Step::Smoothing, ""};
const EditPlace kRemeshing{Step::Remeshing, "cfd"};
const EditPlace kPrint{Step::Deformation, "rp"};

/// Applies an edit and lets everything pending have run.
EditRef done(History& history, const EditPlace& place) {
    const EditRef edit = history.apply(place);
    for (const auto& variant : {std::string(), std::string("cfd"), std::string("rp")}) {
        ResultId input = 0;
        for (const HistoryEntry& entry : history.line(variant)) {
            const HistoryResult* result = history.result_of(entry.edit, input);
            input = result != nullptr ? result->id : history.add_result(entry.edit, input);
        }
    }
    return edit;
}

std::vector<EditId> order(const std::vector<HistoryEntry>& entries) {
    std::vector<EditId> ids;
    for (const auto& entry : entries) ids.push_back(entry.edit.id);
    return ids;
}

std::vector<EditStatus> statuses(const History& history) {
    std::vector<EditStatus> all;
    for (const auto& entry : history.entries()) all.push_back(entry.status);
    return all;
}

constexpr auto kDone = EditStatus::Done;
constexpr auto kPending = EditStatus::Pending;
constexpr auto kStale = EditStatus::Stale;

}  // namespace

SCENARIO("Edits are ordered by step, then by time", "[session][history]") {
    History history;
    done(history, kSource);
    done(history, kSmoothing);
    const EditRef late = history.apply(kRepair);
    CHECK(order(history.entries()) == std::vector<EditId>{1, 3, 2});
    THEN("an edit of an earlier step makes the later ones pending") {
        history.add_result(late, history.entries()[0].result);
        CHECK(statuses(history) == std::vector{kDone, kDone, kPending});
    }
}

SCENARIO("Undo goes to the parent, redo to the child last visited", "[session][history]") {
    History history;
    done(history, kSource);
    const StateId fork = history.current();
    done(history, kRepair);
    const StateId first = history.current();
    history.undo();
    CHECK(history.current() == fork);
    done(history, kSmoothing);
    const StateId second = history.current();
    CHECK(order(history.entries()) == std::vector<EditId>{1, 3});
    history.undo();
    history.redo();
    CHECK(history.current() == second);
    THEN("nothing is thrown away: the other branch is still there") {
        history.jump(first);
        CHECK(order(history.entries()) == std::vector<EditId>{1, 2});
        CHECK(statuses(history) == std::vector{kDone, kDone});
        AND_THEN("it is now the one last visited") {
            history.undo();
            history.redo();
            CHECK(history.current() == first);
        }
    }
    THEN("there are ends") {
        CHECK_THROWS_AS(history.redo(), UsageError);
        history.jump(0);
        CHECK(history.entries().empty());
        CHECK_THROWS_AS(history.undo(), UsageError);
        CHECK_THROWS_AS(history.jump(77), UsageError);
    }
}

SCENARIO("Undo and redo by an edit", "[session][history]") {
    History history;
    for (int i = 0; i < 4; ++i) done(history, kRepair);
    history.undo_before(2);
    CHECK(order(history.entries()) == std::vector<EditId>{1});
    history.redo_to(3);
    CHECK(order(history.entries()) == std::vector<EditId>{1, 2, 3});
    CHECK_THROWS_WITH(history.undo_before(99), Contains("there is no edit 99 (the newest is "));
    CHECK_THROWS_AS(history.undo_before(4), UsageError);
    CHECK_THROWS_AS(history.redo_to(1), UsageError);
}

SCENARIO("A changed edit keeps its id and its place", "[session][history]") {
    History history;
    done(history, kSource);
    const EditRef second = done(history, kRepair);
    done(history, kSmoothing);
    const EditRef changed = history.change(second.id);
    CHECK(changed.id == second.id);
    CHECK(changed.revision == 2);
    CHECK(order(history.entries()) == std::vector<EditId>{1, 2, 3});
    CHECK(statuses(history) == std::vector{kDone, kPending, kPending});
    THEN("undo brings back the old revision with its results") {
        history.undo();
        CHECK(history.find(2) == second);
        CHECK(statuses(history) == std::vector{kDone, kDone, kDone});
        AND_THEN("another change is a third revision") {
            CHECK(history.change(2).revision == 3);
        }
    }
}

SCENARIO("Removing an edit makes the later ones pending", "[session][history]") {
    History history;
    done(history, kSource);
    done(history, kRepair);
    done(history, kRepair);
    history.remove(2);
    CHECK(order(history.entries()) == std::vector<EditId>{1, 3});
    CHECK(statuses(history) == std::vector{kDone, kPending});
    CHECK_THROWS_AS(history.remove(2), UsageError);
    THEN("removing the last one makes nothing pending") {
        history.remove(3);
        CHECK(statuses(history) == std::vector{kDone});
    }
}

SCENARIO("A stale edit passes its input through", "[session][history]") {
    History history;
    done(history, kSource);
    const EditRef broken = history.apply(kRepair);
    const EditRef last = history.apply(kSmoothing);
    const ResultId source = history.entries()[0].result;
    history.add_result(broken, source, "the branch is gone");
    CHECK(statuses(history) == std::vector{kDone, kStale, kPending});
    CHECK(history.entries()[1].reason == "the branch is gone");
    CHECK(history.entries()[2].input == source);
    history.add_result(last, source);
    CHECK(statuses(history) == std::vector{kDone, kStale, kDone});
}

SCENARIO("A variant's edits do not touch the other variants", "[session][history]") {
    History history;
    done(history, kSource);
    done(history, kRemeshing);
    done(history, kPrint);
    CHECK(statuses(history) == std::vector{kDone, kDone, kDone});
    CHECK(order(history.line("cfd")) == std::vector<EditId>{1, 2});
    CHECK(order(history.line("rp")) == std::vector<EditId>{1, 3});
    CHECK(order(history.line("other")) == std::vector<EditId>{1});
    CHECK(history.variants() == std::vector<std::string>{"cfd", "rp"});
    THEN("changing the one leaves the other done") {
        history.change(3);
        CHECK(history.line("rp").back().status == kPending);
        CHECK(history.line("cfd").back().status == kDone);
    }
    THEN("changing the trunk makes both pending") {
        history.apply(kRepair);
        CHECK(history.line("rp").back().status == kPending);
        CHECK(history.line("cfd").back().status == kPending);
    }
}

SCENARIO("A history that contradicts itself is refused", "[session][history]") {
    const std::map<EditRef, EditPlace> edits = {{{1, 1}, kSource}};
    const HistoryState start;
    const HistoryState first{1, 0, StateChange::Apply, {1, 1}, 0};
    CHECK_NOTHROW(History(edits, {start, first}, {}, 1));
    CHECK_THROWS_AS(History(edits, {start, first}, {}, 2), InvalidInput);
    CHECK_THROWS_AS(History(edits, {first}, {}, 1), InvalidInput);
    CHECK_THROWS_AS(History({}, {start, first}, {}, 1), InvalidInput);
    const HistoryState orphan{2, 5, StateChange::Apply, {1, 1}, 0};
    CHECK_THROWS_AS(History(edits, {start, first, orphan}, {}, 1), InvalidInput);
    CHECK_THROWS_AS(History(edits, {start, first}, {{1, {1, 1}, 3, ""}}, 1), InvalidInput);
}
