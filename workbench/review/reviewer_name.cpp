#include "workbench/review/reviewer_name.h"

#include <cstdlib>
#include <map>
#include <memory>

#include <utf8proc.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

struct Release {
    void operator()(utf8proc_uint8_t* text) const { std::free(text); }  // by malloc()
};

constexpr int kCompared =
    UTF8PROC_STABLE | UTF8PROC_COMPAT | UTF8PROC_CASEFOLD | UTF8PROC_IGNORE | UTF8PROC_LUMP;

std::string mapped_text(std::string_view name, int options) {
    utf8proc_uint8_t* made = nullptr;
    const auto size = utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(name.data()),
                                   static_cast<utf8proc_ssize_t>(name.size()), &made,
                                   static_cast<utf8proc_option_t>(options));
    const std::unique_ptr<utf8proc_uint8_t, Release> owner(made);
    if (size < 0) throw InvalidInput("a reviewer's name is no UTF-8 text");
    return {reinterpret_cast<const char*>(made), static_cast<std::size_t>(size)};
}

/// Calls `visit` with each code point.
template <class Visit>
void each_character(std::string_view text, Visit visit) {
    const auto* at = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
    for (auto left = static_cast<utf8proc_ssize_t>(text.size()); left > 0;) {
        utf8proc_int32_t code = 0;
        const auto size = utf8proc_iterate(at, left, &code);
        if (size <= 0) throw InvalidInput("a reviewer's name is no UTF-8 text");
        visit(code);
        at += size;
        left -= size;
    }
}

void append_character(std::string& text, utf8proc_int32_t code) {
    utf8proc_uint8_t bytes[4];
    const auto size = utf8proc_encode_char(code, bytes);
    text.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

bool is_letter_or_digit(utf8proc_int32_t code) {
    const auto category = utf8proc_category(code);
    return (category >= UTF8PROC_CATEGORY_LU && category <= UTF8PROC_CATEGORY_LO) ||
           (category >= UTF8PROC_CATEGORY_ND && category <= UTF8PROC_CATEGORY_NO);
}

/// Small letters of other alphabets by the Latin ones, or the digit's letter, that they look like.
const std::map<utf8proc_int32_t, char> kLookalikes = {
    {0x430, 'a'}, {0x432, 'b'}, {0x435, 'e'}, {0x43a, 'k'}, {0x43c, 'm'}, {0x43d, 'h'},
    {0x43e, 'o'}, {0x440, 'p'}, {0x441, 'c'}, {0x442, 't'}, {0x443, 'y'}, {0x445, 'x'},
    {0x455, 's'}, {0x456, 'i'}, {0x458, 'j'}, {0x501, 'd'}, {0x51b, 'q'}, {0x51d, 'w'},
    {0x3b1, 'a'}, {0x3b2, 'b'}, {0x3b5, 'e'}, {0x3b6, 'z'}, {0x3b7, 'h'}, {0x3b9, 'i'},
    {0x3ba, 'k'}, {0x3bc, 'm'}, {0x3bd, 'n'}, {0x3bf, 'o'}, {0x3c1, 'p'}, {0x3c4, 't'},
    {0x3c5, 'y'}, {0x3c7, 'x'}, {'0', 'o'},   {'1', 'l'}};

}  // namespace

std::string compared_name(std::string_view name) {
    std::string made;
    for (const char c : mapped_text(name, kCompared | UTF8PROC_COMPOSE))
        if (c != ' ' || (!made.empty() && made.back() != ' ')) made += c;
    if (!made.empty() && made.back() == ' ') made.pop_back();
    return made;
}

std::string name_outline(std::string_view name) {
    std::string made;
    each_character(mapped_text(name, kCompared | UTF8PROC_DECOMPOSE | UTF8PROC_STRIPMARK),
                   [&](utf8proc_int32_t code) {
                       if (!is_letter_or_digit(code)) return;
                       const auto like = kLookalikes.find(code);
                       append_character(made, like == kLookalikes.end() ? code : like->second);
                   });
    return made;
}

bool has_hidden_characters(std::string_view name) {
    bool found = false;
    each_character(name, [&](utf8proc_int32_t code) {
        const auto category = utf8proc_category(code);
        found |= category >= UTF8PROC_CATEGORY_CC || category == UTF8PROC_CATEGORY_CN ||
                 category == UTF8PROC_CATEGORY_ZL || category == UTF8PROC_CATEGORY_ZP;
    });
    return found;
}

}  // namespace vesselbench
