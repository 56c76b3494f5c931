#pragma once

#include <map>
#include <string>

namespace vesselbench {

/// The tables of weights by file name (end_odds.h); embedded when the program is built.
[[nodiscard]] const std::map<std::string, std::string>& end_weight_tables();

}  // namespace vesselbench
