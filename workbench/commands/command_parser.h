#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "geometry/kernel/progress.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/messages.h"

namespace vesselbench {

/// Values of options whose words shells complete (shell/command_rows.h).
inline constexpr const char* kRecipeValue = "FILE|RECIPE";
inline constexpr const char* kFilterValue = "FILTER";
inline constexpr const char* kSettingValue = "OPERATION.PARAMETER=VALUE";
inline constexpr const char* kFlowSettingValue = "openfoam.PARAMETER=VALUE";

/// The parser, and the command it found.
struct CommandLine {
    explicit CommandLine(std::stop_token on);

    CLI::App app;
    std::stop_token stop;
    Progress progress;
    std::function<int()> command;
    WindowOptions window;
    MessageOptions messages;
    std::function<void(std::string)> refused;  ///< gets what FailedCommand::refused is
};

/// Adds a command with the options that all have. \param command runs it, and returns its exit code
CLI::App& add_command(CommandLine& line, const std::string& name, const std::string& summary,
                      std::function<int()> command);

/// Adds the argument PROJECT.
void add_project(CLI::App& command, std::string& project);

/// Adds the option --set, which may be repeated. \param value kSettingValue or kFlowSettingValue
void add_settings(CLI::App& command, std::vector<std::string>& settings,
                  const char* help = "operation.parameter=value: change an argument of the recipe",
                  const char* value = kSettingValue);

/// Adds the option --variant. \param help what is done with it; its default follows
void add_variant(CLI::App& command, std::string& variant, const std::string& help);

/// Adds the flag --json.
void add_json(CLI::App& command, bool& json, const char* help = "Print one JSON document");

}  // namespace vesselbench
