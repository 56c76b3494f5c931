#include "workbench/review/page_file.h"

#include <string_view>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

namespace {

constexpr std::string_view kMarker = "<!-- vesselbench data -->";

/// JSON that cannot end the element it is in, whatever texts it holds.
std::string script_safe(const std::string& json) {
    std::string safe;
    safe.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char letter = json[i];
        // U+2028 and U+2029, which end lines of scripts
        const bool separator = letter == '\xe2' && i + 2 < json.size() && json[i + 1] == '\x80' &&
                               (json[i + 2] == '\xa8' || json[i + 2] == '\xa9');
        if (letter == '<')
            safe += "\\u003c";
        else if (letter == '>')
            safe += "\\u003e";
        else if (letter == '&')
            safe += "\\u0026";
        else if (separator)
            safe += json[i + 2] == '\xa8' ? "\\u2028" : "\\u2029";
        else
            safe += letter;
        if (separator) i += 2;
    }
    return safe;
}

std::string elements_of(const std::string& json, const std::map<std::string, std::string>& blobs) {
    std::string text =
        R"(<script type="application/json" id="case">)" + script_safe(json) + "</script>\n";
    for (const auto& [name, packed] : blobs)
        text += R"(<script type="application/octet-stream" id="blob-)" + name + "\">" + packed +
                "</script>\n";
    return text;
}

}  // namespace

void require_page(std::span<const unsigned char> page) {
    const std::string_view text(reinterpret_cast<const char*>(page.data()), page.size());
    if (text.find(kMarker) == std::string_view::npos)
        throw DiagnosedFailure({.code = "no-review-page"});
}

std::string filled_page(std::span<const unsigned char> page, const nlohmann::ordered_json& manifest,
                        const std::map<std::string, std::string>& blobs) {
    require_page(page);
    std::string text(page.begin(), page.end());
    return text.replace(text.find(kMarker), kMarker.size(),
                        elements_of(text_from_json(manifest), blobs));
}

}  // namespace vesselbench
