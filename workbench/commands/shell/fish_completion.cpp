#include "workbench/commands/shell/fish_completion.h"

#include "workbench/commands/shell/completion_words.h"

namespace vesselbench {

namespace {

std::string line(const std::string& condition, const std::string& rest) {
    return "complete -c vesselbench -n " + in_quotes(condition) + " " + rest + "\n";
}

std::string seen(const std::string& command) {
    return "__fish_seen_subcommand_from " + command;
}

std::string option_line(const CommandRow& command, const OptionRow& option) {
    std::string rest = "-l " + option.name.substr(2);
    if (!option.choices.empty())
        rest += (option.takes_files ? " -r -a " : " -x -a ") + in_quotes(spaced(option.choices));
    else if (!option.value.empty())
        rest += " -r";
    return line(seen(command.name), rest + " -d " + in_quotes(brief(option.help)));
}

/// The operations at the third place, their parameters after it.
std::string operation_lines(const std::string& command, std::span<const Operation> operations) {
    std::string lines;
    for (const Operation& operation : operations) {
        lines += line(seen(command) + "; and test (count (commandline -opc)) -eq 3",
                      "-f -a " + operation.name + " -d " + in_quotes(operation.summary));
        const std::string after =
            seen(command) + "; and contains -- " + operation.name + " (commandline -opc)[4..]";
        lines += line(after, "-f -a " + in_quotes(spaced(parameter_words(operation)) + " " +
                                                  spaced(argument_words(operation))));
    }
    return lines;
}

}  // namespace

std::string fish_completion(std::span<const CommandRow> commands,
                            std::span<const Operation> operations) {
    std::string text = "# fish completion for vesselbench\n";
    for (const CommandRow& command : commands)
        text += line("__fish_use_subcommand",
                     "-f -a " + command.name + " -d " + in_quotes(brief(command.summary)));
    for (const CommandRow& command : commands) {
        for (const OptionRow& option : command.options) text += option_line(command, option);
        if (command.takes_operation) text += operation_lines(command.name, operations);
    }
    return text;
}

}  // namespace vesselbench
