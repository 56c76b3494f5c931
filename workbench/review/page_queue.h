#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/review/page_models.h"

namespace vesselbench {

/// Something of a case that a reviewer should look at.
struct QueueItem {
    std::string kind;  ///< "deviation", "choice", "warning", "stale" or "decision"
    EditId edit = 0;
    std::string title, why;        ///< in few words, and in all
    double score = 0.0;            ///< larger: earlier
    std::optional<Vec3> place;     ///< [mm]
    std::optional<double> radius;  ///< of the vessel there [mm]
    bool folded = false;           ///< more likely wrong than right: listed when asked for
};

/// What to look at first: edits that no longer apply, changes that are large beside the vessel's
/// radius, warnings, and decisions of the program.
/// \param log of the variant, in order
[[nodiscard]] std::vector<QueueItem> review_queue(const std::vector<LogEntry>& log,
                                                  const PageModels& models,
                                                  const OperationLookup& find);

/// A list of {"kind", "edit", "title", "why", "score", "place", "radius", "folded"}; place and
/// radius where known, folded where it is.
[[nodiscard]] nlohmann::ordered_json queue_json(const std::vector<QueueItem>& queue);

}  // namespace vesselbench
