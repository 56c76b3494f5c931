#include "workbench/window/model/quality_analysis.h"

#include <chrono>
#include <optional>
#include <utility>

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// Values that change faster are not worth a beginning: the model in the view comes first.
constexpr auto kRest = 60ms;

class QualityAnalysing final : public QualityAnalyses::Work {
public:
    void answer(const QualityQuestion& question, const QualityAnalyses::Turn& turn) override {
        if (!turn.rests(kRest)) return;
        if (!search_ || base_ != question.base || operation_ != question.operation) {
            search_.emplace(*question.operation, question.scene);
            base_ = question.base;
            operation_ = question.operation;
        }
        search_->answer(
            question.given, question.tau,
            [&](const LiveSearch::Answer& found) {
                turn.send({turn.number, found});
            },
            turn.progress);
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
    analyses_.interrupt();
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

void QualityAnalysis::ask(const LiveSmoothing::Followed& followed) {
    const Asked now{followed.form->changes(), tau};
    if (now == asked_ || !followed.form->valid()) return;
    asked_ = now;
    used_ = true;
    analyses_.ask({.scene = *followed.document.current(),
                   .base = base_,
                   .operation = operation_,
                   .given = followed.form->arguments(),
                   .tau = tau});
}

bool QualityAnalysis::update(const LiveSmoothing::Followed& followed, bool paused) {
    const bool wanted = std::exchange(wanted_, false);
    take_form(followed);
    if (can_analyse()) {
        if (paused || !wanted)
            interrupt();
        else
            ask(followed);
    }
    return analyses_.update();
}

}  // namespace vesselbench
