#pragma once

#include <string>
#include <string_view>

namespace vesselbench {

/// A segment's name from a foreign file as it may be stored and shown: in one line, without control
/// characters, of at most 64 bytes.
[[nodiscard]] std::string segment_name(std::string_view foreign);

}  // namespace vesselbench
