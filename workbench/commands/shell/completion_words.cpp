#include "workbench/commands/shell/completion_words.h"

namespace vesselbench {

std::string in_quotes(const std::string& text) {
    std::string safe = "'";
    for (const char letter : text) {
        if (letter == '\'')
            safe += "'\\''";
        else
            safe += letter;
    }
    return safe + "'";
}

std::string brief(const std::string& help) {
    const std::size_t line = help.find('\n'), part = help.find_first_of(";(");
    std::string text = help.substr(0, std::min(line, part));
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

std::string spaced(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<std::string> command_words(std::span<const CommandRow> commands) {
    std::vector<std::string> words;
    for (const CommandRow& command : commands) words.push_back(command.name);
    return words;
}

std::vector<std::string> option_words(const CommandRow& command) {
    std::vector<std::string> words;
    for (const OptionRow& option : command.options) words.push_back(option.name);
    return words;
}

std::vector<std::string> operation_words(std::span<const Operation> operations) {
    std::vector<std::string> words;
    for (const Operation& operation : operations) words.push_back(operation.name);
    return words;
}

std::vector<std::string> argument_words(const Operation& operation) {
    std::vector<std::string> words;
    for (const Parameter& parameter : operation.parameters)
        for (const std::string& choice : parameter.choices)
            words.push_back(parameter.name + "=" + choice);
    return words;
}

}  // namespace vesselbench
