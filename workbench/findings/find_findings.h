#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/findings/dismissals.h"
#include "workbench/findings/finding.h"
#include "workbench/findings/stated_ends.h"

namespace vesselbench {

/// Those that are listed come first: the worst first, as the registry has them, and of one kind the
/// most certain. Then the others, the most certain first.
void put_worst_first(std::vector<Finding>& findings);

/// All detectors on a scene's surface, the worst first. Nothing is changed. A kind that a damaged
/// surface does not let be looked for is said to be not searched. \throw AlgorithmFailure if there
/// is no surface; Cancelled
[[nodiscard]] FindingSearch find_findings(const Scene& scene, const Progress& progress = {});

/// The same where edits have stated what the ends are: they and the findings state one figure.
[[nodiscard]] FindingSearch find_findings(const Scene& scene, const std::vector<StatedEnd>& stated,
                                          const Progress& progress = {});

/// "not looked for: Bump, Dent: the surface ...", a line for each reason.
[[nodiscard]] std::vector<std::string> not_searched_lines(
    const std::vector<NotSearched>& not_searched);

/// A finding as JSON: id, kind, title, certainty, certain_of (what the certainty is of), place_mm,
/// size_mm, evidence, readings (key, name, anatomy, odds and evidence of each; empty: no question),
/// and operation with its arguments (null: none treats it).
[[nodiscard]] nlohmann::ordered_json finding_json(const Finding& finding);

/// Findings of a model, what was dismissed and what was not looked for: {"findings", "dismissed",
/// "not_searched"}.
[[nodiscard]] nlohmann::ordered_json findings_json(const JudgedFindings& findings);

}  // namespace vesselbench
