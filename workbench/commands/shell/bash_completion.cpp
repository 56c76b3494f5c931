#include "workbench/commands/shell/bash_completion.h"

#include "workbench/commands/shell/completion_words.h"
#include "workbench/export/flow_parameters.h"

namespace vesselbench {

namespace {

/// A row of a case: the pattern and the words that follow it.
std::string row(const std::string& pattern, const std::vector<std::string>& words) {
    return words.empty() ? ""
                         : "        " + pattern + ") words=" + in_quotes(spaced(words)) + " ;;\n";
}

std::string values(std::span<const CommandRow> commands) {
    std::string rows;
    for (const CommandRow& command : commands)
        for (const OptionRow& option : command.options)
            rows += row(command.name + "," + option.name, option.choices);
    return rows;
}

/// Of the operations' choices: "filter=" is followed by them.
std::string arguments(std::span<const Operation> operations) {
    std::string rows;
    for (const Operation& operation : operations)
        for (const Parameter& parameter : operation.parameters)
            rows += row(operation.name + "," + parameter.name, parameter.choices);
    return rows;
}

std::string options(std::span<const CommandRow> commands) {
    std::string rows;
    for (const CommandRow& command : commands) rows += row(command.name, option_words(command));
    return rows;
}

std::string parameters(std::span<const Operation> operations) {
    std::string rows;
    for (const Operation& operation : operations)
        rows += row(operation.name, parameter_words(operation));
    return rows;
}

std::string taking_operations(std::span<const CommandRow> commands) {
    std::string names;
    for (const CommandRow& command : commands)
        if (command.takes_operation) names += (names.empty() ? "" : "|") + command.name;
    return names;
}

std::string chosen(const std::string& by, const std::string& rows) {
    return "    case " + by + " in\n" + rows + "    esac\n";
}

}  // namespace

std::string bash_completion(std::span<const CommandRow> commands,
                            std::span<const Operation> operations) {
    return "# bash completion for vesselbench\n"
           "_vesselbench() {\n"
           "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
           "  local command=${COMP_WORDS[1]} operation=${COMP_WORDS[3]} words=''\n"
           "  [ \"$word\" != = ] || { word=''; before==; }\n"
           "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "    words=" +
           in_quotes(spaced(command_words(commands))) +
           "\n  elif [ \"$before\" = = ]; then\n"
           "    local at=$((COMP_CWORD - 1))\n"
           "    [ \"${COMP_WORDS[at]}\" = = ] || at=$COMP_CWORD\n"
           "    local name=${COMP_WORDS[at-1]}\n"
           "    [[ $name != *.* ]] || { operation=${name%%.*}; name=${name#*.}; }\n" +
           chosen("$operation,$name", arguments(operations) + arguments({&flow_table(), 1})) +
           "  elif [[ $word == -* ]]; then\n" + chosen("$command", options(commands)) + "  else\n" +
           chosen("$command,$before", values(commands)) + "    case $command in\n        " +
           taking_operations(commands) +
           ")\n"
           "    if [ \"$COMP_CWORD\" -eq 3 ]; then words=" +
           in_quotes(spaced(operation_words(operations))) +
           "\n    elif [ \"$COMP_CWORD\" -gt 3 ] && [ -z \"$words\" ]; then\n" +
           chosen("$operation", parameters(operations)) +
           "    fi ;;\n    esac\n  fi\n"
           "  [[ $words != *= ]] || compopt -o nospace 2> /dev/null\n"
           "  COMPREPLY=()\n"
           "  [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
           "}\n"
           "complete -o default -F _vesselbench vesselbench\n";
}

}  // namespace vesselbench
