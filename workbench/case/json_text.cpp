#include "workbench/case/json_text.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string place_in(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t newline = before.find_last_of('\n');
    const std::size_t column = newline == std::string_view::npos ? at + 1 : at - newline;
    return ", line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Each value of a text takes up to 64 bytes of memory, but only two of the text.
constexpr std::size_t kMostValues = 8'000'000;

/// The end of the comments that begin there; the same place if none does.
std::size_t after_comments(std::string_view text, std::size_t at) {
    for (;;) {
        const std::string_view begin = text.substr(at, 2);
        if (begin != "//" && begin != "/*") return at;
        const std::size_t end = text.find(begin == "//" ? "\n" : "*/", at + 2);
        if (end == std::string_view::npos) return text.size();
        at = begin == "//" ? end : end + 2;
    }
}

/// The place of the first bracket that is too deep, or of the first value that is one too many; the
/// end of the text if there is none.
std::size_t first_excess(std::string_view text, JsonComments comments) {
    std::size_t depth = 0, values = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (comments == JsonComments::Ignored && !in_text) i = after_comments(text, i);
        if (i == text.size()) break;
        const char c = text[i];
        if (in_text && c == '\\')
            ++i;
        else if (c == '"')
            in_text = !in_text;
        else if (!in_text && (c == '[' || c == '{') && ++depth > kDeepestJson)
            return i;
        else if (!in_text && (c == ']' || c == '}') && depth > 0)
            --depth;
        else if (!in_text && c == ',' && ++values > kMostValues)
            return i;
    }
    return text.size();
}

[[noreturn]] void too_large(const std::string& name, std::uintmax_t size, std::size_t largest) {
    throw InvalidInput(name + " has " + std::to_string(size) + " bytes, but JSON of at most " +
                       std::to_string(largest) + " bytes is read");
}

}  // namespace

nlohmann::ordered_json json_from_text(std::string_view text, const std::string& name,
                                      std::size_t largest, JsonComments comments) {
    if (text.size() > largest) too_large(name, text.size(), largest);
    if (const std::size_t at = first_excess(text, comments); at < text.size())
        throw InvalidInput(name + place_in(text, at) +
                           (text[at] == ','
                                ? ": there are more than " + std::to_string(kMostValues) + " values"
                                : ": lists and objects are more than " +
                                      std::to_string(kDeepestJson) + " deep inside each other"));
    try {
        return Json::parse(text, nullptr, true, comments == JsonComments::Ignored);
    } catch (const Json::parse_error& error) {
        const std::size_t at =
            std::min<std::size_t>(error.byte > 0 ? error.byte - 1 : 0, text.size());
        throw InvalidInput(
            name + place_in(text, at) +
            (at == text.size() ? ": the JSON text ends too early" : ": this is not valid JSON"));
    } catch (const Json::exception&) {
        throw InvalidInput(name + " contains a number that is too large");
    }
}

std::string json_file_text(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > kLargestJsonFile) too_large(bare_name(file), size, kLargestJsonFile);
    return file_content(file);
}

nlohmann::ordered_json json_from_file(const std::filesystem::path& file, JsonComments comments) {
    return json_from_text(json_file_text(file), bare_name(file), kLargestJsonFile, comments);
}

nlohmann::ordered_json printable_json(Json json) {
    if (json.is_string()) return printable(json.get<std::string>());
    if (json.is_structured())
        for (Json& part : json) part = printable_json(std::move(part));
    return json;
}

std::string text_from_json(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vesselbench
