#include "workbench/review/review_page.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/json_text.h"
#include "workbench/review/page_manifest.h"
#include "workbench/review/review_page_bytes.h"

namespace vesselbench {

namespace {

constexpr const char* kMarker = "<!-- vesselbench data -->";

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

ReviewPage review_page(Session& session, const std::string& variant, const OperationLookup& find,
                       PageImages images, const Progress& progress) {
    const std::span<const unsigned char> bytes = review_page_bytes();
    std::string text(bytes.begin(), bytes.end());
    const std::size_t place = text.find(kMarker);
    if (place == std::string::npos) throw DiagnosedFailure({.code = "no-review-page"});
    const std::vector<LogEntry> log = session.log(variant);
    const PageModels models = page_models(session, log, find, {.images = images}, progress);
    const nlohmann::ordered_json manifest =
        page_manifest(session, variant, log, models, images, find);
    std::map<std::string, std::string> blobs = models.geometry.blobs();
    blobs.insert(models.slices.begin(), models.slices.end());
    text.replace(place, std::string(kMarker).size(), elements_of(text_from_json(manifest), blobs));
    return {std::move(text), manifest["queue"]};
}

}  // namespace vesselbench
