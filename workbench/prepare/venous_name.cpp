#include "workbench/prepare/venous_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// English, and what anatomists write in Latin.
constexpr std::array<std::string_view, 20> kVenous = {
    "vein",  "veins",      "vena",    "venae",     "venous",    "cava",   "caval",
    "cavae", "ivc",        "svc",     "portal",    "portae",    "azygos", "azygous",
    "sinus", "hemiazygos", "jugular", "jugularis", "saphenous", "saphena"};

/// A longer word that ends like this is one of them, too: "portalvein".
constexpr std::array<std::string_view, 4> kEndings = {"vein", "veins", "cava", "azygos"};

/// Arteries have a sinus, too.
constexpr std::array<std::string_view, 5> kOfArteries = {"aort", "arter", "carot", "coronar",
                                                         "valsalva"};

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_capital(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// In lower case; a capital behind a small letter begins a word.
std::vector<std::string> words_of(std::string_view name) {
    std::vector<std::string> words;
    char before = ' ';
    for (const char c : name) {
        if (is_letter(c)) {
            if (!is_letter(before) || (is_capital(c) && !is_capital(before))) words.emplace_back();
            words.back() += c;
        }
        before = c;
    }
    for (std::string& word : words) word = lower_case(word);
    return words;
}

bool is_venous(const std::string& word) {
    return std::ranges::count(kVenous, word) > 0 ||
           std::ranges::any_of(kEndings,
                               [&](std::string_view ending) { return word.ends_with(ending); });
}

bool is_of_artery(const std::string& word) {
    return std::ranges::any_of(kOfArteries,
                               [&](std::string_view stem) { return word.starts_with(stem); });
}

}  // namespace

std::optional<VenousName> venous_name(std::string_view name) {
    const std::vector<std::string> words = words_of(name);
    if (std::ranges::count(words, "phase") > 0) return std::nullopt;
    const bool of_artery = std::ranges::any_of(words, is_of_artery);
    std::optional<VenousName> found;
    for (const std::string& word : words) {
        if (!is_venous(word) || (word == "sinus" && of_artery)) continue;
        if (!found) found = VenousName{.word = word};
        if (word.starts_with("porta")) found = VenousName{.word = word, .portal = true};
    }
    return found;
}

}  // namespace vesselbench
