#pragma once

#include <optional>
#include <vector>

#include "workbench/flow/flow_record.h"
#include "workbench/operations/shared/sac_figures.h"
#include "workbench/session/snapshot.h"

namespace vesselbench {

/// The neck that the last of these edits marks which has run; none: no edit marks one.
[[nodiscard]] std::optional<MarkedNeck> marked_neck(const std::vector<LogEntry>& edits);

/// The same for a solver's case.
[[nodiscard]] std::optional<RecordedNeck> recorded_neck(const std::vector<LogEntry>& edits);

/// The sac of a model.
struct ModelSac {
    std::optional<SacFigures> figures;  ///< none: it could not be measured
    std::optional<Diagnostic> warning;  ///< why it was not, or is in doubt
};

/// Measures the sac on a surface that may differ from the one on which its neck was marked.
/// \throw Cancelled
[[nodiscard]] ModelSac measured_sac(const Surface& surface, const MarkedNeck& marked, Keys keys,
                                    const Progress& progress = {});

}  // namespace vesselbench
