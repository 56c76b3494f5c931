#pragma once

#include <functional>
#include <optional>

#include "smoothing/quality/stepwise_analysis.h"
#include "workbench/suggest/search_subject.h"

namespace vesselbench {

/// Quality graphs and suggestions for an operation that smooths, again and again while its
/// arguments change: what was found and measured for earlier ones serves the next. A GPU, if there
/// is one, belongs to the thread of the first call. Not thread-safe.
class LiveSearch {
public:
    /// \param operation of the table, with a search of filters
    LiveSearch(const Operation& operation, Scene scene);

    struct Answer {
        SensitivityAnalysis analysis;   ///< of all parameters of the filter and its weights
        std::optional<Arguments> best;  ///< values of the best of all; none: not known yet
        std::string filter;             ///< that is varied, if nobody has chosen another one
        bool complete = false;          ///< no finer answer follows
    };

    using Receiver = std::function<void(const Answer&)>;

    /// Sends answers, coarse ones first, until it is complete.
    /// \param given by the user, without defaults
    /// \throw as the operation; Cancelled. What was measured until then is kept
    void answer(const Arguments& given, ScoreSettings score, const Receiver& receive,
                const Progress& progress);

private:
    void take_subject(const Arguments& given);
    [[nodiscard]] SmoothingSubject subject_of(const Arguments& given, Arguments& arguments) const;
    void take_best(const SmoothingSubject& now, const Arguments& arguments, ScoreSettings score);

    const Operation& operation_;
    Scene scene_;
    std::optional<SearchSubject> subject_;  ///< at the defaults of the searched parameters
    ChosenEngine chosen_;
    std::optional<ParameterSearch> graphs_, best_;
    Arguments best_for_;  ///< what best_ does not search
};

}  // namespace vesselbench
