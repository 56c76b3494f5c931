#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/prepare/input.h"

namespace vesselbench {

struct PrepareOptions {
    InputOptions input;
    std::string purpose;  ///< its name, see purposes()
    std::string recipe;   ///< a bundled one or a file; empty: the case's own, or the default
    std::vector<std::string> arguments;    ///< "operation.parameter=value"
    std::vector<std::string> refinements;  ///< "x,y,z:radius:edge", as refinements() reads them
    std::filesystem::path out;             ///< folder of the results
    bool resume = false;                   ///< goes on in the folder's project
    std::string author;                    ///< of the edits; empty: the login name
    bool question = false;                 ///< a doubt about vessel ends leaves kEndQuestion
    /// Gets the diagnostics of a preparation that stops, with commands (refused_json); may be
    /// empty.
    std::function<void(const nlohmann::ordered_json&)> refused = {};
};

}  // namespace vesselbench
