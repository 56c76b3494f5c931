#pragma once

#include <functional>
#include <optional>
#include <string>

#include "geometry/kernel/progress.h"
#include "smoothing/quality/stepwise_analysis.h"
#include "workbench/case/arguments.h"

namespace vesselbench {

/// What a live search has found so far.
struct LiveSearchAnswer {
    SensitivityAnalysis analysis;   ///< of all parameters of the filter and its weights, or of
                                    ///< the operation
    std::optional<Arguments> best;  ///< values of the best of all; none: not known yet
    bool leave_as_is = false;       ///< the best is the surface as it is
    std::string filter;             ///< that is varied, if nobody has chosen another one
    bool complete = false;          ///< no finer answer follows
};

/// How an operation is searched.
class LiveSearchWay {
public:
    using Receiver = std::function<void(const LiveSearchAnswer&)>;

    LiveSearchWay() = default;
    virtual ~LiveSearchWay() = default;
    LiveSearchWay(const LiveSearchWay&) = delete;
    LiveSearchWay& operator=(const LiveSearchWay&) = delete;

    /// As LiveSearch::answer.
    virtual void answer(const Arguments& given, double tau, const Receiver& receive,
                        const Progress& progress) = 0;

    /// As LiveSearch::answer_dragged.
    virtual void answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                                const Progress& progress) = 0;
};

}  // namespace vesselbench
