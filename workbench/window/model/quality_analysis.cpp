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
            question.given, {.tau = question.tau},
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
    if (base_ < 0) return;
    base_ = -1;
    asked_ = {};
    analyses_.forget();
}

bool QualityAnalysis::update(const LiveSmoothing::Followed& followed, const LiveSmoothing& live,
                             bool paused) {
    const bool wanted = std::exchange(wanted_, false);
    if (!live.can_follow() || (base_ >= 0 && base_ != live.base())) forget();
    if (!live.can_follow()) return analyses_.update();
    const Asked now{live.base(), followed.form->changes(), tau};
    if (paused || !wanted) {
        if (asked_ != Asked{} && analyses_.pending()) {
            analyses_.interrupt();
            asked_ = {};
        }
    } else if (now != asked_ && followed.form->valid()) {
        asked_ = now;
        base_ = live.base();
        analyses_.ask({.scene = *followed.document.current(),
                       .base = base_,
                       .operation = &followed.form->operation(),
                       .given = followed.form->arguments(),
                       .tau = tau});
    }
    return analyses_.update();
}

}  // namespace vesselbench
