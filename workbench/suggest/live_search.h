#pragma once

#include <memory>

#include "workbench/case/operation.h"
#include "workbench/suggest/live_search_way.h"

namespace vesselbench {

/// Quality graphs and suggestions for an operation with a search, again and again while its
/// arguments change: what was found and measured for earlier ones serves the next. A GPU, if there
/// is one, belongs to the thread of the first call. Not thread-safe.
class LiveSearch {
public:
    /// \param operation of the table, with a search
    LiveSearch(const Operation& operation, Scene scene);

    using Answer = LiveSearchAnswer;
    using Receiver = LiveSearchWay::Receiver;

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

private:
    std::unique_ptr<LiveSearchWay> way_;
};

}  // namespace vesselbench
