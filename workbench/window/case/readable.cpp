#include "workbench/window/case/readable.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"

namespace vesselbench {

namespace {

constexpr double kFirstGrouped = 1e3;  ///< "%.3g" would write it with an exponent
constexpr double kLastGrouped = 1e12;  ///< from here on, digits are harder to read than those

}  // namespace

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

std::string readable_variant(const std::string& variant) {
    std::string title = model_title(variant);
    const std::string model = "Model for ";
    return title.starts_with(model) ? title.substr(model.size()) : title;
}

std::string grouped(std::size_t number) {
    std::string digits = std::to_string(number);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(at, ",");
    return digits;
}

std::string readable_number(double number) {
    const double rounded = three_digits(number), size = std::abs(rounded);
    if (size < kFirstGrouped || size >= kLastGrouped) return formatted(rounded);
    return (rounded < 0.0 ? "-" : "") + grouped(static_cast<std::size_t>(std::llround(size)));
}

}  // namespace vesselbench
