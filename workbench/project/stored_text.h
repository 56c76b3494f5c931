#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/arguments.h"
#include "workbench/project/bytes.h"

namespace vesselbench {

/// Arguments as JSON text, for projects and workers: every value is read back with its type and its
/// bits, for any operation. Points are {"x", "y", "z"}, records {"records": [...]}, numbers not
/// representable in JSON {"real": "inf"}.
[[nodiscard]] std::string stored_text(const Arguments& arguments);

/// A report's text; anything that is not UTF-8 (in a file's name) is replaced.
[[nodiscard]] std::string stored_text(const nlohmann::ordered_json& report);

/// \throw InvalidInput if the text is not such JSON
[[nodiscard]] Arguments arguments_from_stored(const std::string& text);

/// A text as a blob, compressed if that makes it smaller.
/// \throw InvalidInput from unpack_text if it is damaged
[[nodiscard]] Bytes pack_text(const std::string& text);
[[nodiscard]] std::string unpack_text(std::span<const std::byte> blob);

}  // namespace vesselbench
