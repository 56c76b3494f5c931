#pragma once

#include <nlohmann/json_fwd.hpp>

#include "workbench/session/session.h"

namespace vesselbench {

/// One edit with all its data in the project: operation, arguments given and resolved, author,
/// time, duration, note, warnings (their texts, and as diagnostics), and what it changed.
[[nodiscard]] nlohmann::ordered_json log_json(const LogEntry& entry);

/// What an operation reported of its result: a JSON object; empty if it is none.
[[nodiscard]] nlohmann::ordered_json reported(const ResultRecord& result);

/// One line: "volume -2.1 %, moved up to 0.31 mm, 12,400 -> 9,800 triangles"; empty if nothing
/// changed.
[[nodiscard]] std::string change_text(const SurfaceChange& change);

/// The same after what an operation says of its result in one line ("headline" of its report):
/// "120,000 tetrahedra, smallest dihedral angle 11.2 deg". Empty if there is neither.
[[nodiscard]] std::string effect_text(const ResultRecord& result);

}  // namespace vesselbench
