#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "workbench/case/operation.h"

namespace vesselbench {

/// An option of a command.
struct OptionRow {
    std::string name;    ///< "--for"
    std::string letter;  ///< "-h"; empty: none
    std::string value;   ///< what follows it: "FILE", "cfd|rp"; empty: nothing
    std::string help;
    std::vector<std::string> choices;  ///< of the value; empty: any
    bool takes_files = false;          ///< beside the choices
};

/// What can be typed after one command.
struct CommandRow {
    std::string name;
    std::string summary;
    std::vector<std::string> positionals;  ///< "PROJECT", "[parameter=value...]"
    std::vector<OptionRow> options;
    std::string footer;
    bool takes_operation = false;  ///< OPERATION and its arguments follow the project
};

/// The commands that the help lists, in its order.
[[nodiscard]] std::vector<CommandRow> command_rows(const CLI::App& app);

/// "name=" of each parameter that users type.
[[nodiscard]] std::vector<std::string> parameter_words(const Operation& operation);

/// "smooth.filter=" of each parameter that users type, as --set takes them.
[[nodiscard]] std::vector<std::string> setting_words(std::span<const Operation> operations);

}  // namespace vesselbench
