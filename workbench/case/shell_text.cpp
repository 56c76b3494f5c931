#include "workbench/case/shell_text.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace vesselbench {

namespace {

bool needs_no_quotes(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
           std::string_view("_-./=,:+@%").find(letter) != std::string_view::npos;
}

}  // namespace

std::string shell_quoted(const std::string& text) {
    if (!text.empty() && std::ranges::all_of(text, needs_no_quotes)) return text;
    std::string quoted = "'";
    for (const char letter : text) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
    return quoted + "'";
}

}  // namespace vesselbench
