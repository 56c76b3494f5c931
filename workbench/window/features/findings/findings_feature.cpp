#include "workbench/window/features/findings/findings_feature.h"

#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/findings/question.h"
#include "workbench/findings/treatment.h"
#include "workbench/operations/table.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"

namespace vesselbench {

void FindingsFeature::forget_list() {
    search_.forget();
    end_trial();
    refusals_.clear();
    of_.reset();
    findings_.reset();
    at_.reset();
    asked_.reset();
}

void FindingsFeature::forget() {
    forget_list();
    storing_.forget();
    reason.clear();
    unfolded_ = false;
    tour_ = 0;
}

void FindingsFeature::want() {
    const Scene* scene = core_.document.newest();
    if (scene == nullptr || !scene->surface || scene->surface->positions == of_) return;
    findings_.reset();
    at_.reset();
    asked_.reset();
    of_ = scene->surface->positions;
    search_.start([scene = *scene, stated = stated_ends(log()),
                   project = core_.document.project()](const Progress& progress) -> Found {
        return {find_findings(scene, stated, progress), stored_dismissals(project)};
    });
}

void FindingsFeature::judge() {
    findings_ = judged(found_.search, found_.dismissals);
    end_trial();
    refusals_.clear();  // they are by number
    asked_.reset();
    reason.clear();
    if (at_ && *at_ >= findings_->open.size()) at_.reset();
}

bool FindingsFeature::update() {
    bool changed = drop_stale();
    if (search_.poll()) {
        changed = true;
        const int steps = std::exchange(tour_, 0);
        if (auto found = search_.take()) {
            found_ = std::move(*found);
            judge();
            if (steps != 0) go(steps);
        }
    }
    if (trial_.poll()) {
        changed = true;
        auto refusal = trial_.take();
        if (refusal && tried_) refusals_[*tried_] = *std::move(refusal);
        tried_.reset();
    }
    if (storing_.poll()) {
        changed = true;
        if (auto dismissals = storing_.take()) {
            found_.dismissals = std::move(*dismissals);
            if (findings_) judge();
        } else if (!storing_.problem().empty()) {
            core_.document.tell(make_message(MessageKind::Error, storing_.problem()));
        }
    }
    return changed;
}

bool FindingsFeature::drop_stale() {
    const Scene* scene = core_.document.newest();
    const bool same = scene != nullptr && scene->surface && scene->surface->positions == of_;
    if (same || !of_) return false;
    forget_list();
    return true;
}

/// Of the variant that is shown.
std::vector<LogEntry> FindingsFeature::log() const {
    std::vector<LogEntry> log = core_.document.snapshot()->log;
    std::erase_if(log, [&](const LogEntry& entry) {
        return !is_part_of(entry.edit.place, core_.document.variant());
    });
    return log;
}

std::size_t FindingsFeature::listed() const {
    if (!findings_) return 0;
    return unfolded_ ? findings_->open.size() : listed_count(findings_->open);
}

const Finding* FindingsFeature::finding(std::size_t index) const {
    return findings_ && index < findings_->open.size() ? &findings_->open[index] : nullptr;
}

void FindingsFeature::look_at(std::size_t index) {
    const Finding* found = finding(index);
    if (found == nullptr) return;
    at_ = index;
    core_.look_at(found->place);
    try_correction(index);
}

void FindingsFeature::try_correction(std::size_t index) {
    const Finding& found = findings_->open[index];
    if (refusals_.contains(index) || found.treatment() == nullptr ||
        !core_.document.can(RequestKind::Edit))
        return;
    end_trial();
    trial_ = core_.document.runner()->submit(
        [found, variant = core_.document.variant()](Session& session, const Progress& progress) {
            return refusal_of(session, found, variant, progress);
        },
        "trial");
    tried_ = index;
}

void FindingsFeature::end_trial() {
    trial_.forget();
    tried_.reset();
}

const std::string* FindingsFeature::refusal(std::size_t index) const {
    const auto found = refusals_.find(index);
    return found == refusals_.end() || found->second.empty() ? nullptr : &found->second;
}

void FindingsFeature::go(int steps) {
    if (!findings_) {
        tour_ = steps;
        return want();
    }
    const auto count = static_cast<int>(listed());
    if (count == 0) {
        const std::size_t folded = findings_->open.size();
        return core_.document.tell(make_message(
            MessageKind::Remark, "Nothing on the model looks wrong" +
                                     (folded > 0 ? " (" + folded_words(folded, false) + ")" : "")));
    }
    const int from = at_ ? static_cast<int>(*at_) : steps > 0 ? -1 : 0;
    const auto next = static_cast<std::size_t>(((from + steps) % count + count) % count);
    look_at(next);
    const Finding& found = findings_->open[next];
    core_.document.tell(
        make_message(MessageKind::Remark, title_of(found) + " " + std::to_string(next + 1) +
                                              " of " + std::to_string(count) + ": " +
                                              worded(found.evidence, {.window = true})));
}

Step FindingsFeature::step_for(const std::string& operation) const {
    return treatment_step(find_operation(operation), log());
}

void FindingsFeature::treat_at_once(std::size_t index) {
    const Finding* found = finding(index);
    if (found == nullptr || found->treatment() == nullptr || found->asks()) return;
    end_trial();
    const Operation& operation = find_operation(found->treatment()->operation);
    GivenArguments given(operation);
    for (const auto& [name, value] : found->treatment()->arguments) given.set(name, value);
    core_.leave_form();
    core_.document.apply(operation.name, given, step_for(operation.name), treatment_note(*found));
}

void FindingsFeature::change(std::size_t index) {
    const Finding* found = finding(index);
    if (found == nullptr || found->treatment() == nullptr) return;
    end_trial();
    const Remedy treatment = *found->treatment();
    core_.choose(treatment.operation, step_for(treatment.operation));
    for (const auto& [name, value] : treatment.arguments) core_.set_field(name, value);
    look_at(index);
}

void FindingsFeature::keep(std::size_t index) {
    const Finding* found = finding(index);
    if (found != nullptr && found->asks()) return store(*found, kept_reason(*found));
    asked_ = asked_ == index ? std::nullopt : std::optional(index);
    reason.clear();
}

void FindingsFeature::keep_asked() {
    const Finding* found = asked_ ? finding(*asked_) : nullptr;
    if (found == nullptr || reason.find_first_not_of(" \t\n") == std::string::npos) return;
    store(*found, reason);
}

void FindingsFeature::store(const Finding& kept, const std::string& words) {
    storing_.start(
        [project = core_.document.project(), search = found_.search, kept, words](const Progress&) {
            dismiss(project, search, kept, words);
            return stored_dismissals(project);
        });
}

void FindingsFeature::keys(PanelContext& context) {
    if (!core_.document.is_open()) return;
    const auto walk = [&](int steps) {
        context.shown.bottom = BottomTab::Findings;
        go(steps);
    };
    if (context.shown.keys.has(KeyCommand::NextFinding)) walk(1);
    if (context.shown.keys.has(KeyCommand::PreviousFinding)) walk(-1);
}

}  // namespace vesselbench
