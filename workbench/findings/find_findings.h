#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/findings/dismissals.h"
#include "workbench/findings/finding.h"

namespace vesselbench {

/// All detectors on a scene's surface, the most certain findings first, of equals in the order of
/// the registry. Nothing is changed. What a detector cannot find on a damaged surface is not found.
/// \throw AlgorithmFailure if there is no surface; Cancelled
[[nodiscard]] std::vector<Finding> find_findings(const Scene& scene, const Progress& progress = {});

/// A finding as JSON: id, kind, title, certainty, place_mm, size_mm, evidence, and operation with
/// its arguments (null: none treats it).
[[nodiscard]] nlohmann::ordered_json finding_json(const Finding& finding);

/// Findings of a model and what was dismissed: {"findings", "dismissed"}.
[[nodiscard]] nlohmann::ordered_json findings_json(const JudgedFindings& findings);

}  // namespace vesselbench
