#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/recipe_part.h"

namespace vesselbench {

/// What a reader of report.html sees without scrolling: whether the model is fit for its purpose,
/// where it opens, and the worst of what to look at. Long lists are cut short and the rest is
/// counted; the whole lists follow on the page.
/// \param sections whose headline, if their part of the report has one, is a verdict
/// \return `verdicts`, `openings`, `requirements`, `looks` (warnings, then findings)
[[nodiscard]] nlohmann::ordered_json first_screen(const nlohmann::ordered_json& report,
                                                  std::span<const ReportSection> sections);

/// The class of a judgement's text in the page: "good", "bad" or none.
[[nodiscard]] const char* judgement_class(const nlohmann::ordered_json& judgement);

}  // namespace vesselbench
