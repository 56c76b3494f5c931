#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/history.h"

using namespace vesselbench;

namespace {

struct PlainEdit {
    EditRef ref;
    EditPlace place;

    bool operator==(const PlainEdit&) const = default;
};

/// A state that holds all of its edits, in order.
struct PlainState {
    StateId parent = 0;
    StateChange change = StateChange::Start;
    EditRef made;
    std::vector<PlainEdit> edits;
    StateId redo = 0;
};

struct PlainResult {
    EditRef edit;
    ResultId input = 0;
    std::string stale_reason;
};

/// The history of DESIGN 1 in its simplest form: every state keeps its own list, and every search
/// is linear. Each action returns false if it is impossible.
class PlainHistory {
public:
    std::vector<PlainState> states{1};
    std::vector<PlainResult> results{1};
    std::vector<int> revisions{0};  ///< newest of each edit, by its id
    StateId current = 0;

    [[nodiscard]] const PlainState& now() const { return states[current]; }

    bool apply(const EditPlace& place) {
        std::vector<PlainEdit> edits = now().edits;
        const PlainEdit edit{{static_cast<EditId>(revisions.size()), 1}, place};
        revisions.push_back(1);
        const auto later = [&](const PlainEdit& e) { return e.place.step > place.step; };
        edits.insert(std::ranges::find_if(edits, later), edit);
        add(StateChange::Apply, edit.ref, std::move(edits));
        return true;
    }

    bool change(EditId id) {
        std::vector<PlainEdit> edits = now().edits;
        const auto edit = find(edits, id);
        if (edit == edits.end()) return false;
        edit->ref.revision = ++revisions[id];
        add(StateChange::Change, edit->ref, std::move(edits));
        return true;
    }

    bool remove(EditId id) {
        std::vector<PlainEdit> edits = now().edits;
        const auto edit = find(edits, id);
        if (edit == edits.end()) return false;
        const EditRef ref = edit->ref;
        edits.erase(edit);
        add(StateChange::Remove, ref, std::move(edits));
        return true;
    }

    bool undo() {
        if (current == 0) return false;
        const StateId parent = now().parent;
        states[parent].redo = current;
        current = parent;
        return true;
    }

    bool redo() {
        if (now().redo == 0) return false;
        current = now().redo;
        return true;
    }

    bool undo_before(EditId id) {
        StateId at = current;
        const auto makes_it = [&] {
            return states[at].made.id == id && states[at].change != StateChange::Remove;
        };
        while (at != 0 && !makes_it()) at = states[at].parent;
        if (at == 0) return false;
        const StateId target = states[at].parent;
        while (current != target) undo();
        return true;
    }

    bool redo_to(EditId id) {
        for (StateId at = now().redo; at != 0; at = states[at].redo)
            if (states[at].made.id == id) {
                current = at;
                return true;
            }
        return false;
    }

    bool jump(StateId id) {
        if (id < 0 || id >= static_cast<StateId>(states.size())) return false;
        for (StateId at = id; at != 0; at = states[at].parent) states[states[at].parent].redo = at;
        current = id;
        return true;
    }

    bool add_result(EditRef edit, ResultId input, const std::string& reason) {
        results.push_back({edit, input, reason});
        return true;
    }

    /// The newest result of an edit on an input; 0 if it never ran there.
    [[nodiscard]] ResultId result_of(EditRef edit, ResultId input) const {
        for (auto i = static_cast<ResultId>(results.size()) - 1; i > 0; --i)
            if (results[i].edit == edit && results[i].input == input) return i;
        return 0;
    }

    /// Entries of one variant's line: its edits' statuses, one after the other.
    [[nodiscard]] std::vector<HistoryEntry> line(const std::string& variant) const {
        std::vector<HistoryEntry> entries;
        ResultId input = 0;
        bool known = true;  // what the next edit runs on
        for (const PlainEdit& edit : now().edits) {
            if (!edit.place.variant.empty() && edit.place.variant != variant) continue;
            HistoryEntry entry{edit.ref, edit.place, EditStatus::Pending, 0, known ? input : 0, ""};
            entry.result = known ? result_of(edit.ref, input) : 0;
            entry.reason = results[entry.result].stale_reason;
            known = known && entry.result != 0;
            if (known) entry.status = entry.reason.empty() ? EditStatus::Done : EditStatus::Stale;
            if (entry.status == EditStatus::Done) input = entry.result;
            entries.push_back(entry);
        }
        return entries;
    }

private:
    static std::vector<PlainEdit>::iterator find(std::vector<PlainEdit>& edits, EditId id) {
        return std::ranges::find_if(edits, [&](const PlainEdit& e) { return e.ref.id == id; });
    }

    void add(StateChange change, EditRef made, std::vector<PlainEdit> edits) {
        states.push_back({current, change, made, std::move(edits), 0});
        states[current].redo = static_cast<StateId>(states.size()) - 1;
        current = states[current].redo;
    }
};

auto facts(const HistoryEntry& entry) {
    // The input of a pending edit after another one is undefined.
    const ResultId input = entry.status == EditStatus::Pending ? 0 : entry.input;
    return std::tuple(entry.edit, entry.place.step, entry.place.variant, entry.status, entry.result,
                      input, entry.reason);
}

bool same_lines(const History& history, const PlainHistory& plain) {
    return std::ranges::all_of(std::vector<std::string>{"", "cfd", "rp"}, [&](const auto& variant) {
        return std::ranges::equal(history.line(variant), plain.line(variant), {}, facts, facts);
    });
}

bool same_now(const History& history, const PlainHistory& plain) {
    return history.current() == plain.current && history.states().size() == plain.states.size() &&
           history.edits().rbegin()->first.id + 1 == static_cast<EditId>(plain.revisions.size()) &&
           history.results().size() + 1 == plain.results.size() && same_lines(history, plain);
}

/// Every state ever made, its redo, its edits, every revision and result ever made.
bool same_everywhere(const History& history, const PlainHistory& plain) {
    History there = history;
    PlainHistory plain_there = plain;
    for (const auto& [id, state] : history.states()) {
        const PlainState& other = plain.states[id];
        if (std::tuple(state.parent, state.change, state.edit, state.last_child) !=
            std::tuple(other.parent, other.change, other.made, other.redo))
            return false;
        there.jump(id);
        plain_there.jump(id);
        if (!same_lines(there, plain_there)) return false;
    }
    for (std::size_t i = 1; i < plain.results.size(); ++i) {
        const HistoryResult& result = history.results().at(static_cast<ResultId>(i));
        if (std::tuple(result.edit, result.input, result.stale_reason) !=
            std::tuple(plain.results[i].edit, plain.results[i].input,
                       plain.results[i].stale_reason))
            return false;
    }
    for (std::size_t id = 1; id < plain.revisions.size(); ++id)
        for (int revision = 1; revision <= plain.revisions[id]; ++revision)
            if (!history.edits().contains({static_cast<EditId>(id), revision})) return false;
    return true;
}

History rebuilt(const History& history) {
    std::vector<HistoryState> states;
    for (const auto& [id, state] : history.states()) states.push_back(state);
    std::vector<HistoryResult> results;
    for (const auto& [id, result] : history.results()) results.push_back(result);
    return {history.edits(), std::move(states), std::move(results), history.current()};
}

/// Does a random action on both. \return whether both succeeded, or both failed and are unchanged
class RandomUser {
public:
    explicit RandomUser(unsigned seed) : random_(seed) {}

    bool act(History& history, PlainHistory& plain) {
        static const std::vector<std::pair<int, bool (RandomUser::*)(History&, PlainHistory&)>>
            habits = {{16, &RandomUser::apply},  {12, &RandomUser::change},
                      {14, &RandomUser::remove}, {30, &RandomUser::run},
                      {12, &RandomUser::step},   {8, &RandomUser::step_by_edit},
                      {4, &RandomUser::jump},    {4, &RandomUser::run_somewhere}};
        int left = below(100);
        for (const auto& [share, habit] : habits)
            if ((left -= share) < 0) return (this->*habit)(history, plain);
        return false;
    }

private:
    int below(std::size_t end) { return static_cast<int>(random_() % end); }

    /// An id that was assigned, or the next one.
    EditId some_edit(const PlainHistory& plain) { return 1 + below(plain.revisions.size()); }

    /// Mostly one that the state holds.
    EditId held_edit(const PlainHistory& plain) {
        const auto& edits = plain.now().edits;
        return edits.empty() || below(8) == 0 ? some_edit(plain)
                                              : edits[below(edits.size())].ref.id;
    }

    template <typename Action>
    static bool both(bool possible, Action&& action) {
        try {
            action();
            return possible;
        } catch (const UsageError&) {
            return !possible;
        }
    }

    bool apply(History& history, PlainHistory& plain) {
        static const std::vector<EditPlace> places = {
            {Step::Source, ""},        {Step::LocalRepair, ""},  {Step::Openings, ""},
            {Step::Smoothing, ""},     {Step::Remeshing, "cfd"}, {Step::Product, "cfd"},
            {Step::Deformation, "rp"}, {Step::Product, "rp"}};
        const EditPlace& place = places[below(places.size())];
        return both(plain.apply(place), [&] { history.apply(place); });
    }

    bool change(History& history, PlainHistory& plain) {
        const EditId id = held_edit(plain);
        return both(plain.change(id), [&] { history.change(id); });
    }

    bool remove(History& history, PlainHistory& plain) {
        const EditId id = held_edit(plain);
        return both(plain.remove(id), [&] { history.remove(id); });
    }

    bool step(History& history, PlainHistory& plain) {
        return below(2) == 0 ? both(plain.undo(), [&] { history.undo(); })
                             : both(plain.redo(), [&] { history.redo(); });
    }

    bool step_by_edit(History& history, PlainHistory& plain) {
        const EditId id = below(2) == 0 ? held_edit(plain) : some_edit(plain);
        return below(2) == 0 ? both(plain.undo_before(id), [&] { history.undo_before(id); })
                             : both(plain.redo_to(id), [&] { history.redo_to(id); });
    }

    bool jump(History& history, PlainHistory& plain) {
        const StateId id = below(plain.states.size() + 1);
        return both(plain.jump(id), [&] { history.jump(id); });
    }

    /// Runs the first pending edits of a variant, as showing its result does; some do not apply.
    bool run(History& history, PlainHistory& plain) {
        for (int edits = 1 + below(4); edits > 0; --edits) {
            const auto line = history.line(below(2) == 0 ? "cfd" : "rp");
            const auto pending =
                std::ranges::find(line, EditStatus::Pending, &HistoryEntry::status);
            if (pending == line.end()) return true;
            add_result(history, plain, pending->edit, pending->input);
        }
        return true;
    }

    /// A result on any input, possibly again on the same one.
    bool run_somewhere(History& history, PlainHistory& plain) {
        if (plain.revisions.size() == 1) return true;
        const EditId id = 1 + below(plain.revisions.size() - 1);
        add_result(history, plain, {id, 1 + below(plain.revisions[id])},
                   below(plain.results.size()));
        return true;
    }

    void add_result(History& history, PlainHistory& plain, EditRef edit, ResultId input) {
        const std::string reason = below(6) == 0 ? "no wall " + std::to_string(below(9)) : "";
        plain.add_result(edit, input, reason);
        history.add_result(edit, input, reason);
    }

    std::mt19937 random_;
};

}  // namespace

SCENARIO("A history does what a plain list of states does", "[session][history]") {
    RandomUser user(20240611);
    History history;
    PlainHistory plain;
    history.apply({Step::Source, ""});
    plain.apply({Step::Source, ""});
    int edits = 0;
    for (int action = 1; action <= 10000; ++action) {
        INFO("action " << action);
        REQUIRE(user.act(history, plain));
        REQUIRE(same_now(history, plain));
        edits = std::max(edits, static_cast<int>(plain.now().edits.size()));
        if (action % 2500 != 0) continue;
        REQUIRE(same_everywhere(history, plain));
        history = rebuilt(history);
        REQUIRE(same_everywhere(history, plain));
    }
    CHECK(edits > 8);  // the actions had an effect
    CHECK(plain.states.size() > 2000);
    CHECK(std::ranges::count_if(plain.results,
                                [](const auto& r) { return !r.stale_reason.empty(); }) > 200);
}
