#pragma once

#include <string>

namespace vesselbench {

/// Bytes as text (RFC 4648), for data inside pages.
[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace vesselbench
