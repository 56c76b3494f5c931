#include "geometry/kernel/printable.h"

#include <array>
#include <cstdio>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

std::string escaped(unsigned char byte) {
    std::array<char, 5> text{};
    std::snprintf(text.data(), text.size(), "\\x%02x", byte);
    return text.data();
}

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

/// False for characters written longer than needed, surrogates, and those beyond U+10FFFF.
bool may_follow(unsigned char first, unsigned char second) {
    const unsigned char least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned char most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    return second >= least && second <= most;
}

/// Bytes of the UTF-8 character at the front; 0 if there is none.
std::size_t character_size(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
    if (size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if (!continues(text[i])) return 0;
    if (size > 1 && !may_follow(first, static_cast<unsigned char>(text[1]))) return 0;
    return size;
}

/// C0 and C1 controls, DEL, and what ends or reorders the line (Unicode's separators of lines and
/// paragraphs, and its bidirectional controls).
bool is_control(std::string_view character) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
    if (character.size() == 1)
        return (byte(0) < 0x20 && byte(0) != '\n' && byte(0) != '\t') || byte(0) == 0x7f;
    if (character.size() == 2) return byte(0) == 0xc2 && byte(1) < 0xa0;
    return character.size() == 3 && byte(0) == 0xe2 &&
           ((byte(1) == 0x80 && byte(2) >= 0xa8 && byte(2) <= 0xae) ||
            (byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9));
}

}  // namespace

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        if (size == 0) return false;
        text.remove_prefix(size);
    }
    return true;
}

void require_utf8(std::string_view text, const std::string& what) {
    if (!is_utf8(text))
        throw UsageError(what + " '" + shortened(printable(text)) +
                         "' is not UTF-8 text: write it in a terminal that uses UTF-8");
}

std::string printable(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const std::string_view character = text.substr(0, size == 0 ? 1 : size);
        if (size == 0 || is_control(character))
            for (const char c : character) shown += escaped(static_cast<unsigned char>(c));
        else
            shown += character;
        text.remove_prefix(character.size());
    }
    return shown;
}

std::string shortened(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && continues(text[end])) --end;
    return text.substr(0, end) + "...";
}

}  // namespace vesselbench
