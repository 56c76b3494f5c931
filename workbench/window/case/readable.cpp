#include "workbench/window/case/readable.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace vesselbench {

std::string readable_unit(const std::string& unit) {
    if (unit == "-") return "";
    std::string words = unit;
    for (const auto& [typed, raised] : {std::pair{"^2", "\u00B2"}, std::pair{"^3", "\u00B3"}})
        if (const auto at = words.find(typed); at != std::string::npos)
            words.replace(at, 2, raised);
    if (words.ends_with("m2")) words.replace(words.size() - 1, 1, "\u00B2");
    if (words.ends_with("m3")) words.replace(words.size() - 1, 1, "\u00B3");
    return words;
}

std::optional<double> typed_number(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    if (first == std::string::npos) return std::nullopt;
    const char* begin = text.data() + first + (text[first] == '+' ? 1 : 0);
    const char* end = text.data() + last + 1;
    double number = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
    return number;
}

}  // namespace vesselbench
