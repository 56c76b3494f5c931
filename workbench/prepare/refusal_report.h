#pragma once

#include <exception>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/prepare/prepare_options.h"
#include "workbench/prepare/recipe.h"

namespace vesselbench {

/// The diagnostics of a preparation that stopped, as diagnostic_json() has them, and each remedy
/// that can be given as it is as `commands` to be run one after the other, each a list of
/// arguments. An answer about how the input is read begins again; the others resume.
/// \param rest of the recipe: a command that resumes keeps the settings of these entries
[[nodiscard]] nlohmann::ordered_json refused_json(const PrepareOptions& options,
                                                  const std::exception& error, const Recipe& rest);

/// report.json of a preparation that stopped: why, with the diagnostics as refused_json().
/// \param earlier_results names of what earlier preparations left in the folder
[[nodiscard]] nlohmann::ordered_json refusal_json(const PrepareOptions& options,
                                                  const std::exception& error,
                                                  const std::vector<std::string>& earlier_results,
                                                  const Recipe& rest = {});

}  // namespace vesselbench
