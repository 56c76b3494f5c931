#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// A diagnostic in the form used in projects, reports and failures: code, severity, text, operation
/// (empty: the one that ran), edit if it is known, place_mm (null: none), figures, words, and
/// remedies, each an operation and its arguments.
[[nodiscard]] nlohmann::ordered_json diagnostic_json(const Diagnostic& diagnostic);

[[nodiscard]] nlohmann::ordered_json diagnostics_json(const std::vector<Diagnostic>& diagnostics);

/// The same for reports, with the severity "note" where projects store a warning that is_note().
[[nodiscard]] nlohmann::ordered_json reported_json(const std::vector<Diagnostic>& diagnostics);

/// What diagnostic_json() made, or a text alone, as old projects have it.
/// \param place in the JSON document, for errors
/// \throw InvalidInput if it is neither
[[nodiscard]] Diagnostic diagnostic_from(const nlohmann::ordered_json& json,
                                         const std::string& place);

/// A list of them.
[[nodiscard]] std::vector<Diagnostic> diagnostics_from(const nlohmann::ordered_json& json,
                                                       const std::string& place);

}  // namespace vesselbench
