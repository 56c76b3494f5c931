#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/review/page_models.h"

namespace vesselbench {

/// All that the review page says of a variant besides its surfaces' blobs: case, edits with
/// arguments, figures, warnings and verdicts, the queue, the report's figures. Contains no folders
/// and no more of images than asked for.
/// \param find of operations; of those it does not know, arguments are listed as stored
[[nodiscard]] nlohmann::ordered_json page_manifest(const Session& session,
                                                   const std::string& variant,
                                                   const std::vector<LogEntry>& log,
                                                   const PageModels& models, PageImages images,
                                                   const OperationLookup& find);

}  // namespace vesselbench
