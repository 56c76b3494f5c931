#include "geometry/kernel/diagnostic_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "geometry/kernel/catalogue.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Splits at the first separator. \return the parts; the second one is empty without a separator
std::pair<std::string, std::string> split(const std::string& text, char separator) {
    const std::size_t at = text.find(separator);
    if (at == std::string::npos) return {text, ""};
    return {text.substr(0, at), text.substr(at + 1)};
}

/// Replaces the places of values in catalogue texts.
class Filler {
public:
    Filler(const Diagnostic& diagnostic, const RemedyWords& remedy_words)
        : diagnostic_(diagnostic), remedy_words_(remedy_words) {}

    /// \return none: a value is not known
    [[nodiscard]] std::optional<std::string> filled(std::string_view text) const {
        std::string result;
        while (!text.empty()) {
            const std::size_t special = std::min(text.find_first_of("{["), text.size());
            result += text.substr(0, special);
            text.remove_prefix(special);
            if (text.empty()) break;
            const bool optional = text.front() == '[';
            const std::string_view inner = text.substr(1, text.find(optional ? ']' : '}') - 1);
            const auto part = optional ? filled(inner) : value(std::string(inner));
            if (!part && !optional) return std::nullopt;
            result += part.value_or("");
            text.remove_prefix(inner.size() + 2);
        }
        return result;
    }

private:
    [[nodiscard]] std::optional<std::string> value(const std::string& inner) const {
        if (const auto& [name, nouns] = split(inner, '#'); !nouns.empty()) {
            const auto figure = diagnostic_.figures.find(name);
            if (figure == diagnostic_.figures.end()) return std::nullopt;
            const auto& [noun, plural] = split(nouns, '|');
            return counted(static_cast<std::size_t>(std::max(figure->second, 0.0)), noun, plural);
        }
        const auto& [name, format] = split(inner, ':');
        if (name == "place") {
            if (!diagnostic_.place) return std::nullopt;
            return place_text(*diagnostic_.place);
        }
        if (name == "fix") return remedy(0);
        if (name == "fix2") return remedy(1);
        if (const auto word = diagnostic_.words.find(name); word != diagnostic_.words.end())
            return word->second;
        const auto figure = diagnostic_.figures.find(name);
        if (figure == diagnostic_.figures.end()) return std::nullopt;
        return formatted(figure->second, format.empty() ? "%.3g" : format.c_str());
    }

    [[nodiscard]] std::optional<std::string> remedy(std::size_t i) const {
        if (i >= diagnostic_.remedies.size()) return std::nullopt;
        return remedy_words_(diagnostic_, diagnostic_.remedies[i]);
    }

    const Diagnostic& diagnostic_;
    const RemedyWords& remedy_words_;
};

/// Readable, whatever is known: of a newer version's project, say.
std::string text_without_entry(const Diagnostic& diagnostic) {
    std::vector<std::string> parts;
    for (const auto& [name, word] : diagnostic.words) parts.push_back(name + " " + word);
    for (const auto& [name, figure] : diagnostic.figures)
        parts.push_back(name + " " + formatted(figure));
    if (diagnostic.place) parts.push_back("at " + place_text(*diagnostic.place));
    return diagnostic.code + (parts.empty() ? "" : ": " + joined(parts));
}

}  // namespace

std::string plain_remedy(const Diagnostic& diagnostic, const Remedy& remedy) {
    const bool own =
        !remedy.before && (remedy.operation.empty() || remedy.operation == diagnostic.operation);
    if (remedy.action != RemedyAction::Give) {
        const std::string edit =
            diagnostic.edit ? "edit " + std::to_string(*diagnostic.edit) : "the edit";
        return remedy.action == RemedyAction::Remove ? "removing " + edit
                                                     : "letting " + edit + " choose again";
    }
    std::vector<std::string> words;
    if (!own || remedy.arguments.empty()) words.push_back(remedy.operation);
    for (const auto& [name, value] : remedy.arguments)
        words.push_back(value.empty() ? name : name + "=" + value);
    return joined(words, " ");
}

std::string filled(const char* text, const Diagnostic& diagnostic,
                   const RemedyWords& remedy_words) {
    const auto words = Filler(diagnostic, remedy_words).filled(text);
    if (!words) throw std::out_of_range(diagnostic.code + " lacks a value of its text: " + text);
    return *words;
}

std::string text_of(const Diagnostic& diagnostic, const RemedyWords& remedy_words) {
    const auto texts = catalogue();
    const auto entry = std::ranges::find_if(
        texts, [&](const CatalogueText& text) { return diagnostic.code == text.code; });
    if (entry == texts.end()) return text_without_entry(diagnostic);
    return Filler(diagnostic, remedy_words)
        .filled(entry->text)
        .value_or(text_without_entry(diagnostic));
}

}  // namespace vesselbench
