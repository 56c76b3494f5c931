#pragma once

#include <vector>

#include "workbench/case/scene.h"
#include "workbench/report/requirements.h"
#include "workbench/session/source_counterpart.h"

namespace vesselbench {

/// What a prepared model is judged by. The distances are from the source's wall, away from the ends
/// that were made; what was removed otherwise counts as lost. Those to neighbours are from the
/// walls of both, away from these ends too.
/// \param source after the edit that made its surface; without a surface there are no distances
/// \param edits of the model, for what it was remeshed for
[[nodiscard]] ModelFigures model_figures(const Scene& source, const Scene& model,
                                         const std::vector<MadeEnd>& ends,
                                         const std::vector<LogEntry>& edits);

}  // namespace vesselbench
