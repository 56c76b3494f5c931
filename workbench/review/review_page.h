#pragma once

#include <string>

#include "workbench/review/page_models.h"
#include "workbench/session/session.h"

namespace vesselbench {

struct ReviewPage {
    std::string html;              ///< self-contained
    nlohmann::ordered_json queue;  ///< queue_json() of what it lists first
};

/// The page in which experts review a variant's edits. Pending ones run first: what has no result
/// cannot be looked at.
/// \param find of operations
/// \throw DiagnosedFailure if the build has no page; what a pending edit throws
[[nodiscard]] ReviewPage review_page(Session& session, const std::string& variant,
                                     const OperationLookup& find,
                                     PageImages images = PageImages::Contours,
                                     const Progress& progress = {});

}  // namespace vesselbench
