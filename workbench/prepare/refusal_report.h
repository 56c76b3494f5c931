#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic.h"
#include "workbench/prepare/prepare_options.h"

namespace vesselbench {

/// report.json of a preparation that stopped: why, and each remedy as commands to be run one after
/// the other, each a list of arguments.
/// \param earlier_results names of what earlier preparations left in the folder
[[nodiscard]] nlohmann::ordered_json refusal_json(const PrepareOptions& options,
                                                  const DiagnosedFailure& failure,
                                                  const std::vector<std::string>& earlier_results);

}  // namespace vesselbench
