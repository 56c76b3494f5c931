#include "workbench/commands/command_parser.h"

#include <utility>

#include "workbench/commands/console/messages.h"

namespace vesselbench {

CommandLine::CommandLine(std::stop_token on)
    : app("vesselbench turns vessel images and raw vessel surfaces into CFD models and print "
          "models.",
          "vesselbench"),
      stop(std::move(on)),
      progress(console_progress(stop)) {}

namespace {

void add_messages(CLI::App& command, MessageOptions& messages) {
    command.add_flag("-q,--quiet", messages.quiet,
                     "Write no messages and no progress to stderr, only errors");
    command
        .add_option("--log", messages.log,
                    "Append messages and progress, with their times, to this file")
        ->type_name("FILE");
}

}  // namespace

CLI::App& add_command(CommandLine& line, const std::string& name, const std::string& summary,
                      std::function<int()> command) {
    CLI::App& added = *line.app.add_subcommand(name, summary);
    add_messages(added, line.messages);
    added.callback([&line, run = std::move(command)] { line.command = run; });
    return added;
}

void add_project(CLI::App& command, std::string& project) {
    command.add_option("PROJECT", project, "Project file (.vbench)")->required()->type_name("");
}

void add_settings(CLI::App& command, std::vector<std::string>& settings, const char* help,
                  const char* value) {
    command.add_option("--set", settings, help)->allow_extra_args(false)->type_name(value);
}

void add_variant(CLI::App& command, std::string& variant, const std::string& help) {
    command
        .add_option("--variant", variant,
                    help +
                        "\n(default: what the project was prepared for last, else its only one, "
                        "else cfd)")
        ->type_name("NAME");
}

void add_json(CLI::App& command, bool& json, const char* help) {
    command.add_flag("--json", json, help);
}

}  // namespace vesselbench
