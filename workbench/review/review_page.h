#pragma once

#include <string>

#include "workbench/review/page_models.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// One self-contained page in which experts review a variant's edits.
/// \param find of operations
/// \throw DiagnosedFailure if the build has no page
[[nodiscard]] std::string review_page(Session& session, const std::string& variant,
                                      const OperationLookup& find,
                                      PageImages images = PageImages::Contours,
                                      const Progress& progress = {});

}  // namespace vesselbench
