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

/// True if a word ends before the place, and "vesselbench" before that.
bool follows_command(std::string_view text, std::size_t at) {
    std::size_t verb = at;
    while (verb > 0 && std::islower(static_cast<unsigned char>(text[verb - 1])) != 0) --verb;
    return verb < at && text.substr(0, verb).ends_with("vesselbench ");
}

}  // namespace

std::string shell_quoted(const std::string& text) {
    if (!text.empty() && std::ranges::all_of(text, needs_no_quotes)) return text;
    std::string quoted = "'";
    for (const char letter : text) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
    return quoted + "'";
}

std::string with_project(const std::string& text, const std::string& project) {
    constexpr std::string_view kName = " project.vbench ";
    const std::string word = shell_quoted(project);
    std::string result = text;
    for (std::size_t at = result.find(kName); at != std::string::npos;
         at = result.find(kName, at + 1))
        if (follows_command(result, at)) result.replace(at + 1, kName.size() - 2, word);
    return result;
}

}  // namespace vesselbench
