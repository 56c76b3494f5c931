#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"
#include "workbench/commands/shell/command_rows.h"

namespace vesselbench {

/// In single quotes, as all shells read them.
[[nodiscard]] std::string in_quotes(const std::string& text);

/// The first sentence or line of a help text.
[[nodiscard]] std::string brief(const std::string& help);

/// Words separated by spaces.
[[nodiscard]] std::string spaced(const std::vector<std::string>& words);

[[nodiscard]] std::vector<std::string> command_words(std::span<const CommandRow> commands);
[[nodiscard]] std::vector<std::string> option_words(const CommandRow& command);
[[nodiscard]] std::vector<std::string> operation_words(std::span<const Operation> operations);

/// "filter=laplace": the arguments whose values are known.
[[nodiscard]] std::vector<std::string> argument_words(const Operation& operation);

}  // namespace vesselbench
