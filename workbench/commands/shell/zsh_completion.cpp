#include "workbench/commands/shell/zsh_completion.h"

#include "workbench/commands/shell/completion_words.h"

namespace vesselbench {

namespace {

/// Of a specification of _arguments: what separates its parts is escaped.
std::string escaped(const std::string& text) {
    std::string safe;
    for (const char letter : text) {
        if (std::string("[]:\\").find(letter) != std::string::npos) safe += '\\';
        safe += letter;
    }
    return safe;
}

std::string option_words(const OptionRow& option) {
    std::string text =
        option.name + (option.value.empty() ? "" : "=") + "[" + escaped(brief(option.help)) + "]";
    if (option.value.empty()) return in_quotes(text);
    text += ":" + escaped(option.value) + ":";
    if (option.choices.empty()) return in_quotes(text + "_files");
    const std::string words = spaced(option.choices);
    return in_quotes(
        text + (option.takes_files ? "{compadd -- " + words + "; _files}" : "(" + words + ")"));
}

std::string arguments_of(const CommandRow& command, std::span<const Operation> operations) {
    std::string words;
    for (const OptionRow& option : command.options) words += " \\\n        " + option_words(option);
    if (!command.takes_operation) return words + " \\\n        '*:file:_files'";
    return words + " \\\n        '1:project:_files' \\\n        " +
           in_quotes("2:operation:(" + spaced(operation_words(operations)) + ")") +
           " \\\n        '*:parameter:_vesselbench_parameters'";
}

std::string parameter_rows(std::span<const Operation> operations) {
    std::string rows;
    for (const Operation& operation : operations)
        rows += "    " + operation.name + ") compadd -S '' -- " +
                spaced(parameter_words(operation)) + " ;;\n";
    return rows;
}

/// What follows "filter=".
std::string value_rows(std::span<const Operation> operations) {
    std::string rows;
    for (const Operation& operation : operations)
        for (const Parameter& parameter : operation.parameters)
            if (!parameter.choices.empty())
                rows += "    " + operation.name + "," + parameter.name + ") compadd -- " +
                        spaced(parameter.choices) + " ;;\n";
    return rows;
}

}  // namespace

std::string zsh_completion(std::span<const CommandRow> commands,
                           std::span<const Operation> operations) {
    std::string described, rows;
    for (const CommandRow& command : commands) {
        described +=
            "    " + in_quotes(command.name + ":" + escaped(brief(command.summary))) + "\n";
        rows += "    " + command.name + ")\n      _arguments" + arguments_of(command, operations) +
                " ;;\n";
    }
    return "#compdef vesselbench\n"
           "_vesselbench_parameters() {\n"
           "  if compset -P '*='; then\n"
           "    case $words[3],${IPREFIX%=} in\n" +
           value_rows(operations) +
           "    esac\n"
           "    return\n"
           "  fi\n"
           "  case $words[3] in\n" +
           parameter_rows(operations) +
           "  esac\n"
           "}\n"
           "_vesselbench() {\n"
           "  local -a commands=(\n" +
           described +
           "  )\n"
           "  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
           "  shift words\n"
           "  (( CURRENT-- ))\n"
           "  case $words[1] in\n" +
           rows +
           "  esac\n"
           "}\n"
           "_vesselbench \"$@\"\n";
}

}  // namespace vesselbench
