#include "workbench/batch/page_parts.h"

#include <cstdlib>

#include "workbench/project/content_hash.h"
#include "workbench/report/base64.h"

namespace vesselbench {

std::string source_hash(const std::string& text) {
    const std::string hex = hash_of_text(text);
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::strtol(hex.substr(i, 2).c_str(), nullptr, 16));
    return "sha256-" + base64(bytes);
}

nlohmann::ordered_json or_false(const std::string& text) {
    return text.empty() ? nlohmann::ordered_json(false) : nlohmann::ordered_json(text);
}

}  // namespace vesselbench
