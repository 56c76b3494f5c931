#pragma once

#include <optional>
#include <string>

namespace vesselbench {

/// What a vessel end is in the model.
enum class EndRole { Inlet, Open, Closed };

[[nodiscard]] std::string to_string(EndRole role);  ///< "inlet", "open", "closed"

/// None: there is no such role.
[[nodiscard]] std::optional<EndRole> end_role(const std::string& text);

}  // namespace vesselbench
