#include "workbench/window/features/quality/quality_analysis.h"

#include <chrono>
#include <optional>
#include <utility>

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// Values that change faster are not worth a beginning: the model in the view comes first.
constexpr auto kRest = 60ms;

/// During a drag, for the best of all before a newer value ends its search [s].
constexpr double kPatience = 1.0;

class QualityAnalysing final : public Answerer<QualityQuestion, QualityAnswer> {
public:
    void answer(const QualityQuestion& question, const TaskTurn<QualityAnswer>& turn) override {
        if (!question.dragged && !turn.rests(kRest)) return;
        if (!search_ || base_ != question.base || operation_ != question.operation) {
            search_.emplace(*question.operation, question.scene);
            base_ = question.base;
            operation_ = question.operation;
        }
        const auto send = [&](const LiveSearch::Answer& found) { turn.send({turn.number, found}); };
        if (question.dragged)
            search_->answer_dragged(question.given, question.tau, send, turn.progress);
        else
            search_->answer(question.given, question.tau, send, turn.progress);
    }

    void forget() override { search_.reset(); }

private:
    std::optional<LiveSearch> search_;
    int base_ = 0;
    const Operation* operation_ = nullptr;
};

}  // namespace

QualityAnalyses::Maker quality_analysing() {
    return [] { return std::make_unique<QualityAnalysing>(); };
}

QualityAnalysis::QualityAnalysis(std::function<void()> wake)
    : analyses_(std::move(wake), quality_analysing()) {}

void QualityAnalysis::forget() {
    if (!std::exchange(used_, false)) return;
    asked_ = {};
    analyses_.forget();
}

void QualityAnalysis::interrupt() {
    if (asked_ == Asked{} || !analyses_.pending()) return;
    analyses_.drop();
    asked_ = {};
}

/// Answers to another form, or about another model, are dropped.
void QualityAnalysis::take_form(const LiveSmoothing::Followed& followed) {
    const Operation* operation =
        followed.form != nullptr && followed.form->operation().search.possible()
            ? &followed.form->operation()
            : nullptr;
    const Scene* scene = followed.document.current();
    auto positions = scene != nullptr && scene->surface ? scene->surface->positions : nullptr;
    if (operation != operation_ || positions != positions_) {
        forget();
        ++base_;
    }
    operation_ = operation;
    positions_ = std::move(positions);
    why_not_ = has_form() ? why_not_followed(followed) : "";
    if (!can_analyse()) forget();
}

/// Values that change in every frame would keep all suggestions from being seen.
bool QualityAnalysis::lets_finish() const {
    if (!asked_.dragged || !analyses_.pending()) return false;
    const bool has_suggestions = analyses_.newest() && analyses_.newest()->question == question_;
    return !has_suggestions || since_asked_.seconds() < kPatience;
}

void QualityAnalysis::ask(const LiveSmoothing::Followed& followed, bool dragged) {
    const Asked now{followed.form->changes(), tau, dragged};
    if (now == asked_ || !followed.form->valid() || (dragged && lets_finish())) return;
    asked_ = now;
    used_ = true;
    since_asked_ = {};
    question_ = vesselbench::ask(analyses_, QualityQuestion{.scene = *followed.document.current(),
                                                            .base = base_,
                                                            .operation = operation_,
                                                            .given = followed.form->arguments(),
                                                            .tau = tau,
                                                            .dragged = dragged});
}

bool QualityAnalysis::update(const LiveSmoothing::Followed& followed, QualityPace pace) {
    const bool wanted = std::exchange(wanted_, false);
    take_form(followed);
    if (can_analyse()) {
        if (pace == QualityPace::Paused || !wanted)
            interrupt();
        else
            ask(followed, pace == QualityPace::Dragged);
    }
    return analyses_.poll();
}

}  // namespace vesselbench
