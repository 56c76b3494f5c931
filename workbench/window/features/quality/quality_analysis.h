#pragma once

#include <functional>
#include <memory>
#include <string>

#include "geometry/kernel/stopwatch.h"
#include "workbench/suggest/live_search.h"
#include "workbench/window/case/answerer.h"
#include "workbench/window/features/live/live_smoothing.h"

namespace vesselbench {

/// What a form is to be analysed for.
struct QualityQuestion {
    Scene scene;
    int base = 0;  ///< number of the scene: equal ones are the same
    const Operation* operation = nullptr;
    Arguments given;       ///< without defaults
    double tau = 0.5;      ///< target of the suggestions [-]
    bool dragged = false;  ///< rough answers are wanted, and soon
};

/// When the window has time for an analysis.
enum class QualityPace {
    Full,
    Dragged,  ///< the mouse changes values: suggestions follow it, graphs are coarse
    Paused    ///< other work comes first: the last answer stays
};

struct QualityAnswer {
    std::uint64_t question = 0;
    LiveSearch::Answer found;
};

using QualityAnalyses = AnswerTask<QualityQuestion, QualityAnswer>;

/// Work that answers with graphs and suggestions.
[[nodiscard]] QualityAnalyses::Maker quality_analysing();

/// The quality graphs and suggestions of a form whose operation has a search (thesis 6.5.3-6.5.5),
/// while they are looked at. Used by the frame's thread.
class QualityAnalysis {
public:
    /// \param wake called by another thread when update() has something to do
    explicit QualityAnalysis(std::function<void()> wake);

    /// In every frame in which they are seen, before update().
    void want() { wanted_ = true; }

    /// Once a frame. \return true if what is known has changed
    bool update(const LiveSmoothing::Followed& followed, QualityPace pace);

    /// True if the form is of an operation with a search.
    [[nodiscard]] bool has_form() const { return operation_ != nullptr; }

    /// Why the form cannot be analysed; empty: it can.
    [[nodiscard]] const std::string& why_not() const { return why_not_; }

    [[nodiscard]] bool can_analyse() const { return has_form() && why_not_.empty(); }

    /// The newest answer, which may be one to earlier values; null: none for this model.
    [[nodiscard]] const LiveSearch::Answer* answer() const {
        return analyses_.newest() ? &analyses_.newest()->found : nullptr;
    }

    /// Why there is none; empty: no problem.
    [[nodiscard]] const std::string& problem() const { return analyses_.problem(); }

    /// True while a finer answer, or one to newer values, is to come.
    [[nodiscard]] bool pending() const { return analyses_.pending(); }

    double tau = 0.5;  ///< target of the suggestions, in [0, 1] [-]

private:
    void take_form(const LiveSmoothing::Followed& followed);
    void ask(const LiveSmoothing::Followed& followed, bool dragged);
    [[nodiscard]] bool lets_finish() const;
    void interrupt();
    void forget();

    struct Asked {
        int changes = -1;
        double tau = -1.0;
        bool dragged = false;

        bool operator==(const Asked&) const = default;
    };

    QualityAnalyses analyses_;
    bool wanted_ = false, used_ = false;  ///< something was asked since forget()
    const Operation* operation_ = nullptr;
    std::string why_not_;
    std::shared_ptr<const Positions> positions_;  ///< of the model that is analysed
    int base_ = 0;                                ///< its number
    Asked asked_;
    std::uint64_t question_ = 0;  ///< number of the last one
    Stopwatch since_asked_;
};

}  // namespace vesselbench
