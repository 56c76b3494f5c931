#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "smoothing/quality/stepwise_analysis.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Quality graphs and suggestions for an operation with a search, again and again while its
/// arguments change: what was found and measured for earlier ones serves the next. A GPU, if there
/// is one, belongs to the thread of the first call. Not thread-safe.
class LiveSearch {
public:
    /// \param operation of the table, with a search
    LiveSearch(const Operation& operation, Scene scene);

    struct Answer {
        SensitivityAnalysis analysis;   ///< of all parameters of the filter and its weights, or of
                                        ///< the operation
        std::optional<Arguments> best;  ///< values of the best of all; none: not known yet
        bool leave_as_is = false;       ///< the best is the surface as it is
        std::string filter;             ///< that is varied, if nobody has chosen another one
        bool complete = false;          ///< no finer answer follows
    };

    using Receiver = std::function<void(const Answer&)>;

    /// Sends answers, coarse ones first, until it is complete.
    /// \param given by the user, without defaults
    /// \param tau target of the operation's usual score, in [0, 1] [-]
    /// \throw as the operation; UsageError if a given argument replaces what is searched;
    /// Cancelled. What was measured until then is kept
    void answer(const Arguments& given, double tau, const Receiver& receive,
                const Progress& progress);

    /// Sends rough answers, none of them complete, while a value is dragged: soon, and on the
    /// calling thread only. Values are taken as the nearest of the graphs' own, so that all is
    /// known before long, wherever the drag goes. \throw as answer
    void answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                        const Progress& progress);

    /// How an operation is searched.
    class Way {
    public:
        Way() = default;
        virtual ~Way() = default;
        Way(const Way&) = delete;
        Way& operator=(const Way&) = delete;

        /// As LiveSearch::answer.
        virtual void answer(const Arguments& given, double tau, const Receiver& receive,
                            const Progress& progress) = 0;

        /// As LiveSearch::answer_dragged.
        virtual void answer_dragged(const Arguments& given, double tau, const Receiver& receive,
                                    const Progress& progress) = 0;
    };

private:
    std::unique_ptr<Way> way_;
};

}  // namespace vesselbench
