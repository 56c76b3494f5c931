#include "geometry/kernel/wording.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

std::string coordinates(const char* format, const Vec3& point) {
    char text[80];
    std::snprintf(text, sizeof text, format, point.x(), point.y(), point.z());
    return text;
}

}  // namespace

std::string coordinates_text(const Vec3& point) {
    return coordinates("(%.5g, %.5g, %.5g)", point);
}

std::string coordinates_argument(const Vec3& point) {
    return coordinates("%.5g,%.5g,%.5g", point);
}

std::string place_text(const Vec3& point) {
    return coordinates_text(point) + " mm";
}

std::string counted(std::size_t count, const std::string& noun, const std::string& plural) {
    const std::string& many = plural.empty() ? noun + "s" : plural;
    return std::to_string(count) + " " + (count == 1 ? noun : many);
}

std::string joined(std::span<const std::string> names, const std::string& separator) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
    return text;
}

std::string enumerated(const std::vector<std::string>& words, const std::string& last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " " + last + " " : ", ";
        text += words[i];
    }
    return text;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (const char letter : printable(text))
        result += letter == '&'   ? "&amp;"
                  : letter == '<' ? "&lt;"
                  : letter == '>' ? "&gt;"
                  : letter == '"' ? "&quot;"
                                  : std::string(1, letter);
    return result;
}

std::string formatted(double value, const char* format) {
    const int length = std::snprintf(nullptr, 0, format, value);
    std::string text(static_cast<std::size_t>(std::max(length, 0)), '\0');
    std::snprintf(text.data(), text.size() + 1, format, value);
    return text;
}

double three_digits(double value) {
    return std::stod(formatted(value));
}

}  // namespace vesselbench
