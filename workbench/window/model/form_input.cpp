#include "workbench/window/model/form_input.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "workbench/session/edit_place.h"

namespace vesselbench {

namespace {

std::vector<HistoryEntry> input_entries(const Document& document, const OperationForm& form,
                                        Step step) {
    const History& history = *document.snapshot()->history;
    if (form.edit()) return entries_before(history, *form.edit());
    EditOptions options;
    options.step = step;
    options.variant = document.variant();
    return entries_before(history, place_of(form.operation(), options, history));
}

std::optional<HistoryEntry> last_done(const std::vector<HistoryEntry>& entries) {
    const auto found = std::find_if(entries.rbegin(), entries.rend(), [](const HistoryEntry& e) {
        return e.status == EditStatus::Done;
    });
    return found == entries.rend() ? std::nullopt : std::optional(*found);
}

/// True if the document's own model is the result of this edit.
bool is_last(const Document& document, const HistoryEntry& entry) {
    const auto last = last_done(document.snapshot()->history->line(document.variant()));
    return last && last->result == entry.result;
}

}  // namespace

void FormInput::forget() {
    if (job_) job_->cancel();
    job_.reset();
    asked_.reset();
    scene_.reset();
    problem_.clear();
}

void FormInput::update(Document& document, const OperationForm& form, Step step) {
    take();
    std::vector<HistoryEntry> before;
    try {
        before = input_entries(document, form, step);
    } catch (const UsageError& error) {
        forget();
        problem_ = error.what();
        return;
    }
    const auto last = last_done(before);
    const bool runs = std::ranges::count(before, EditStatus::Pending, &HistoryEntry::status) == 0;
    if (!last || !runs) {
        forget();
        problem_ = last ? "the edits before this one have to run first" : "there is no model yet";
        return;
    }
    if (asked_ != last->result) {
        forget();
        asked_ = last->result;
    }
    if (is_last(document, *last)) {
        // The document may still read it: the one at hand is then of another state.
        if (document.current() != nullptr) scene_ = *document.current();
    } else if (pending() && !job_ && !document.activity() && !document.is_painting()) {
        job_ = document.runner()->scene_after(last->edit.id);
    }
}

void FormInput::take() {
    if (!job_ || !job_->ended()) return;
    const Job<Scene> job = *std::exchange(job_, std::nullopt);
    if (job.state() == JobState::Cancelled) return;
    try {
        scene_ = job.result();
    } catch (const std::exception& error) {
        problem_ = error.what();
    }
}

}  // namespace vesselbench
