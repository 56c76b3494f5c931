#include "workbench/commands/command_line.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/case/shell_text.h"
#include "workbench/case/version.h"
#include "workbench/commands/cohort_commands.h"
#include "workbench/commands/command_parser.h"
#include "workbench/commands/console/crash_report.h"
#include "workbench/commands/flow_commands.h"
#include "workbench/commands/measuring_commands.h"
#include "workbench/commands/preparing_commands.h"
#include "workbench/commands/project_commands.h"
#include "workbench/commands/recipe_commands.h"
#include "workbench/commands/shell/shell_commands.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/case_files.h"
#include "workbench/window/case/user_folders.h"

namespace vesselbench {

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 the operation could not be done, 2 wrong usage, 3 the input is "
    "bad.\nSee 'vesselbench COMMAND --help' for a command, 'vesselbench operations' for the "
    "operations.";

void show_window(const CommandLine& line) {
    if (line.window.screenshot.empty())
        open_window(line.window, line.stop);
    else
        draw_screenshot(line.window);
}

void add_operations(CommandLine& line) {
    const auto options = std::make_shared<OperationsOptions>();
    CLI::App& command = add_command(line, "operations", "List the operations and their parameters",
                                    [options] { return list_operations(*options), 0; });
    command.add_option("NAME", options->name, "Explain this operation only")->type_name("");
    add_json(command, options->json);
    command.add_flag("--markdown", options->markdown, "Print the page docs/user/operations.md")
        ->group("");
}

void add_phantom(CommandLine& line) {
    const auto options = std::make_shared<PhantomOptions>();
    CLI::App& command =
        add_command(line, "phantom", "Write a phantom's image, mask and exact surface",
                    [options, &line] { return write_phantom(*options, line.progress), 0; });
    command.add_option("--seed", options->seed,
                       "Seed of its noise (default: from its description)");
    command
        .add_option("NAME", options->name,
                    "One of " + joined(phantom_names()) +
                        ", or a file (.json) that describes one, like those in cases/phantoms")
        ->required()
        ->type_name("");
    command.add_option("--out", options->out, "Folder; created if missing")
        ->required()
        ->type_name("FOLDER");
    add_json(command, options->json);
}

void add_doctor(CommandLine& line) {
    const auto json = std::make_shared<bool>(false);
    CLI::App& command = add_command(
        line, "doctor", "Say what the program finds here, what is missing, and how to get it",
        [json] { return check_system(*json), 0; });
    add_json(command, *json);
}

void add_docs(CommandLine& line) {
    const auto options = std::make_shared<DocsOptions>();
    CLI::App& command =
        add_command(line, "docs", "Show the handbook in the browser, or what it says about words",
                    [options] { return show_docs(*options), 0; });
    command.add_option("WORDS", options->words, "To search for")->type_name("");
    add_json(command, options->json);
}

void add_window(CommandLine& line) {
    CLI::App& command =
        add_command(line, "open", "Open a project, a surface, an image or a case in the window",
                    [&line] { return show_window(line), 0; });
    command.add_option("FILE", line.window.file, "What to open; without it, the window asks")
        ->type_name("");
    line.app
        .add_option("--screenshot", line.window.screenshot,
                    "Draw the window once to this file (.png), without a display")
        ->type_name("FILE");
    line.app.add_option("--size", line.window.size, "Of the screenshot [pixels]")
        ->capture_default_str()
        ->type_name("WIDTHxHEIGHT");
    line.app.add_option("--theme", line.window.theme, "Of the screenshot")
        ->capture_default_str()
        ->type_name("dark|light");
}

void set_up(CommandLine& line) {
    line.app.footer(kFooter);
    line.app.set_version_flag("--version", "vesselbench " + version(),
                              "Print the version and exit");
    line.app.set_help_flag("-h,--help", "Print this help and exit");
    line.app.failure_message(CLI::FailureMessage::simple);
    line.app.require_subcommand(0, 1);
    add_window(line);
    add_preparing_commands(line);
    add_cohort_commands(line);
    add_recipe_commands(line);
    add_project_commands(line);
    add_measuring_commands(line);
    add_flow_commands(line);
    add_operations(line);
    add_phantom(line);
    add_doctor(line);
    add_docs(line);
    add_shell_commands(line);
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) names.push_back(command->get_name());
    return names;
}

void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments.front().starts_with("-")) return;
    const std::string& name = arguments.front();
    const auto is_meant = [&](const CLI::App* command) { return command->get_name() == name; };
    if (!app.get_subcommands(is_meant).empty()) return;
    const std::vector<std::string> names = command_names(app);
    throw UsageError("there is no command '" + name + "' in this version" +
                     did_you_mean(name, names) + " (the commands are " + joined(names) + ")");
}

/// "help" and "help COMMAND" as "--help" and "COMMAND --help".
std::vector<std::string> arguments_of(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty() || arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

/// As it may be typed again: " prepare 'a b.stl' --for cfd".
std::string command_text(const std::vector<std::string>& arguments) {
    std::string text;
    for (const std::string& argument : arguments) text += " " + shell_quoted(argument);
    return text;
}

/// The command with wrong arguments: the user needs its help.
std::string help_hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    return " (see 'vesselbench " + command + "--help')";
}

/// An option of the chosen command; null: it has none of this name, or was not given it.
const CLI::Option* given_option(const CLI::App& app, const char* name) {
    const auto chosen = app.get_subcommands();
    if (chosen.empty()) return nullptr;
    const CLI::Option* found = chosen.front()->get_option_no_throw(name);
    return found != nullptr && found->count() > 0 ? found : nullptr;
}

/// The project that the command works on; empty: none, or several.
std::string project_of(const CLI::App& app) {
    const auto value = [&](const char* name) {
        const CLI::Option* given = given_option(app, name);
        return given != nullptr && given->count() == 1 ? given->as<std::string>() : "";
    };
    if (app.got_subcommand("prepare"))
        return (std::filesystem::path(value("--out")) / kProjectFile).string();
    return value("PROJECT");
}

}  // namespace

int run_command_line(int argc, char** argv, const std::stop_token& stop, FailedCommand& command) {
    CommandLine line(stop);
    line.refused = [&command](std::string json) { command.refused = std::move(json); };
    set_up(line);
    std::vector<std::string> arguments = arguments_of(argc, argv);
    // Not asked from the parser: it may refuse another argument first.
    command.json = std::ranges::find(arguments, "--json") != arguments.end();
    refuse_unknown_command(line.app, arguments);
    const std::string typed = command_text(arguments);
    std::ranges::reverse(arguments);  // as the parser wants them
    try {
        line.app.parse(arguments);
    } catch (const CLI::Success& done) {  // --help, --version
        return line.app.exit(done, std::cout, std::cerr);
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what() + help_hint(line.app));
    }
    set_messages(line.messages);
    note_in_log("begin: vesselbench" + typed + " (" + version() + ")");
    const auto chosen = line.app.get_subcommands();
    report_crashes(state_folder(), chosen.empty() ? "window" : chosen.front()->get_name());
    if (!line.command) {
        show_window(line);
        return 0;
    }
    if (const CLI::Option* edit = given_option(line.app, "EDIT"))
        command.edit = edit->as<std::int64_t>();
    command.audience = {.project = project_of(line.app),
                        .preparing = line.app.got_subcommand("prepare")};
    return line.command();
}

}  // namespace vesselbench
