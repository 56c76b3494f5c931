#include "workbench/commands/shell/shell_commands.h"

#include <iostream>
#include <memory>

#include "workbench/commands/shell/bash_completion.h"
#include "workbench/commands/shell/fish_completion.h"
#include "workbench/commands/shell/manual_page.h"
#include "workbench/commands/shell/zsh_completion.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

constexpr const char* kCompletionFooter =
    "A package has them installed already. Without one, in bash:\n"
    "  source <(vesselbench completion bash)";

std::string completion(const std::string& shell, const CLI::App& app) {
    const std::vector<CommandRow> commands = command_rows(app);
    if (shell == "fish") return fish_completion(commands, operation_table());
    if (shell == "zsh") return zsh_completion(commands, operation_table());
    return bash_completion(commands, operation_table());
}

}  // namespace

void add_shell_commands(CommandLine& line) {
    const auto shell = std::make_shared<std::string>();
    CLI::App& command =
        add_command(line, "completion", "Print the script with which a shell completes commands",
                    [shell, &line] {
                        std::cout << completion(*shell, line.app);
                        return 0;
                    });
    command.add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->type_name("")
        ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""));
    command.footer(kCompletionFooter);
    add_command(line, "manual", "Print the manual page", [&line] {
        std::cout << manual_page(command_rows(line.app), operation_table());
        return 0;
    }).group("");
}

}  // namespace vesselbench
