#pragma once

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/diagnostic.h"
#include "workbench/prepare/prepare.h"

namespace vesselbench {

/// report.json of a preparation that stopped: why, and each remedy as commands to be run one after
/// the other, each a list of arguments.
[[nodiscard]] nlohmann::ordered_json refusal_json(const PrepareOptions& options,
                                                  const DiagnosedFailure& failure);

}  // namespace vesselbench
