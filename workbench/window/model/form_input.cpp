#include "workbench/window/model/form_input.h"

#include <algorithm>
#include <exception>
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
    key_.reset();
    last_.reset();
    scene_.reset();
    problem_.clear();
}

void FormInput::update(Document& document, const OperationForm& form, Step step) {
    take();
    const Key key{document.snapshot_changes(), form.edit(), step};
    if (key_ != key) {
        find_last(document, form, step);
        key_ = key;
    }
    if (!last_) return;
    if (is_current_) {
        // The document may still read it: the one at hand is then of another state.
        if (document.current() != nullptr) scene_ = *document.current();
    } else if (pending() && !job_ && !document.activity() && !document.is_painting()) {
        job_ = document.runner()->scene_after(last_->edit.id);
    }
}

void FormInput::find_last(const Document& document, const OperationForm& form, Step step) {
    std::vector<HistoryEntry> before;
    std::string problem;
    try {
        before = input_entries(document, form, step);
    } catch (const UsageError& error) {
        problem = error.what();
    }
    auto last = last_done(before);
    if (std::ranges::count(before, EditStatus::Pending, &HistoryEntry::status) > 0) {
        problem = "the edits before this one have to run first";
        last.reset();
    } else if (!last && problem.empty()) {
        problem = "there is no model yet";
    }
    const bool same = last && last_ && last->result == last_->result;
    if (!same) forget();
    last_ = std::move(last);
    is_current_ = last_ && is_last(document, *last_);
    problem_ = std::move(problem);
}

void FormInput::take() {
    if (!job_ || !job_->ended()) return;
    const Task<Scene> job = *std::exchange(job_, std::nullopt);
    if (job.state() == TaskState::Cancelled) return;
    try {
        scene_ = job.result();
    } catch (const std::exception& error) {
        problem_ = error.what();
        last_.reset();
    }
}

}  // namespace vesselbench
