#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/arguments.h"
#include "workbench/project/bytes.h"

namespace vesselbench {

/// Arguments as the JSON text in which projects keep them and workers get them: every value comes
/// back with its type and its bits, whatever operation it belongs to. Points are {"x", "y", "z"},
/// numbers that JSON does not know {"real": "inf"}.
[[nodiscard]] std::string stored_text(const Arguments& arguments);

/// A report's text; what is not UTF-8 in it (a file's name) is replaced.
[[nodiscard]] std::string stored_text(const nlohmann::ordered_json& report);

/// \throw InvalidInput if the text is no such JSON
[[nodiscard]] Arguments arguments_from_stored(const std::string& text);

/// A text as a blob, compressed where that pays.
/// \throw InvalidInput from unpack_text if it is damaged
[[nodiscard]] Bytes pack_text(const std::string& text);
[[nodiscard]] std::string unpack_text(std::span<const std::byte> blob);

}  // namespace vesselbench
