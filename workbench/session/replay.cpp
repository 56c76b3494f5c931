#include "workbench/session/replay.h"

#include "geometry/kernel/errors.h"
#include "workbench/session/replay_tolerance.h"

namespace vesselbench {

namespace {

/// Bit for bit; results of a GPU by tolerance, because devices round differently.
void compare(const ResultRecord& stored, const Scene& replayed_scene, CaseStore& store,
             EditRunner& runner, ReplayEntry& replayed) {
    const std::vector<std::string> names = store.project().differences(stored.id, replayed_scene);
    if (stored.device == "gpu" && names == std::vector<std::string>{"positions"}) {
        const auto distance =
            replay_distance(surface_of(runner.load(stored.id)), surface_of(replayed_scene));
        if (distance) replayed.distance = distance->largest;
        if (distance && distance->allowed) return;
    }
    replayed.differences.insert(replayed.differences.end(), names.begin(), names.end());
}

/// Why an edit has no stored result.
std::string not_stored_text(const HistoryEntry& entry) {
    switch (entry.status) {
        case EditStatus::Pending:
            return "pending: it has not run on what is before it now";
        case EditStatus::Stale:
            return "it does not apply: " + entry.reason;
        case EditStatus::Done:
            break;
    }
    return "its result is in memory only: the project cannot be written";
}

ReplayEntry replay_one(CaseStore& store, EditRunner& runner, const HistoryEntry& entry,
                       const Progress& progress) {
    ReplayEntry replayed;
    replayed.edit = entry.edit;
    replayed.operation = store.edit(entry.edit).operation;
    replayed.variant = entry.place.variant;
    if (entry.status != EditStatus::Done || store.is_own(entry.result)) {
        replayed.note = not_stored_text(entry);
        return replayed;
    }
    replayed.differences = store.project().damages(entry.result, progress);
    try {
        const HistoryResult& result = store.history().results().at(entry.result);
        const Outcome outcome = runner.rerun(result, progress);
        replayed.replayed = true;
        replayed.note = runner.excess(result, outcome, progress.silent());
        compare(*store.record(entry.result), outcome.scene, store, runner, replayed);
    } catch (const Cancelled&) {
        throw;
    } catch (const IoError& error) {
        replayed.note =
            std::string("not run again, but its stored result is whole: ") + error.what();
    } catch (const std::exception& error) {
        replayed.differences.push_back(std::string("it now fails: ") + error.what());
    }
    return replayed;
}

}  // namespace

std::vector<ReplayEntry> replay(CaseStore& store, EditRunner& runner, const Progress& progress) {
    const auto entries = store.history().entries();
    std::vector<ReplayEntry> replayed;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto whole = static_cast<double>(entries.size());
        replayed.push_back(replay_one(
            store, runner, entries[i],
            progress.part(static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole)));
    }
    return replayed;
}

}  // namespace vesselbench
