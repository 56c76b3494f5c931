#include "workbench/window/shell/key_layout.h"

#include <cctype>
#include <string_view>

#include "workbench/window/keys/keys.h"

namespace vesselbench {

namespace {

constexpr int kLetters = 26;
/// A Latin layout may print punctuation where a US keyboard has letters (Dvorak: three times).
constexpr int kLeastLetters = kLetters / 2;
/// What a US keyboard prints without Shift; the keys' numbers are these characters in capitals.
constexpr std::string_view kPrinted = "',-./0123456789;=[\\]`abcdefghijklmnopqrstuvwxyz";

bool is_letter(const std::string& name) {
    return name.size() == 1 && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
}

bool prints_latin(const KeyNames& names) {
    int letters = 0;
    for (int i = 0; i < kLetters; ++i)
        if (is_letter(names(keys::kA + i))) ++letters;
    return letters >= kLeastLetters;
}

char lower(char letter) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

bool is_printed(int position) {
    return position > keys::kSpace && position < 127 &&
           kPrinted.find(lower(static_cast<char>(position))) != std::string_view::npos;
}

}  // namespace

int key_by_layout(int position, const KeyNames& names) {
    if (!is_printed(position)) return position;
    const std::string name = names(position);
    if (name.size() != 1 || kPrinted.find(lower(name[0])) == std::string_view::npos)
        return position;
    return prints_latin(names) ? std::toupper(static_cast<unsigned char>(name[0])) : position;
}

int PressedKeys::press(int position, const KeyNames& names) {
    const auto [found, is_new] = numbers_.try_emplace(position, position);
    if (is_new) found->second = key_by_layout(position, names);
    return found->second;
}

int PressedKeys::release(int position) {
    const auto found = numbers_.find(position);
    if (found == numbers_.end()) return position;
    const int number = found->second;
    numbers_.erase(found);
    return number;
}

}  // namespace vesselbench
