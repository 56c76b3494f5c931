#include "workbench/command_line.h"

#include <functional>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

#include "geometry/errors.h"
#include "workbench/commands/commands.h"
#include "workbench/near_names.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/version.h"

namespace vesselbench {

namespace {

constexpr const char* kDescription =
    "vesselbench turns vessel images and raw vessel surfaces into CFD models and print models.";

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 the operation could not be done, 2 wrong usage, 3 the input is bad.\n"
    "'vesselbench COMMAND --help' explains a command, 'vesselbench operations' the operations.";

/// The parser, and what to do with what it found.
struct CommandLine {
    explicit CommandLine(Progress p) : progress(std::move(p)) {}

    CLI::App app{kDescription, "vesselbench"};
    Progress progress;
    std::function<int()> command;
};

CLI::App& add_command(CommandLine& line, const std::string& name, const std::string& summary,
                      std::function<int()> command) {
    CLI::App& added = *line.app.add_subcommand(name, summary);
    added.callback([&line, run = std::move(command)] { line.command = run; });
    return added;
}

void add_operations(CommandLine& line) {
    const auto options = std::make_shared<OperationsOptions>();
    CLI::App& command = add_command(line, "operations", "List the operations and their parameters",
                                    [options] { return list_operations(*options), 0; });
    command.add_option("NAME", options->name, "Explain this operation only");
    command.add_flag("--json", options->json, "Print one JSON document");
    command.add_flag("--markdown", options->markdown, "Print the page docs/operations.md")
        ->group("");
}

void add_measure(CommandLine& line) {
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App& command =
        add_command(line, "measure", "Measure a surface, also against a reference surface",
                    [options] { return measure_surface(*options), 0; });
    command.add_option("SURFACE", options->surface, "Surface file")->required();
    command.add_option("REFERENCE", options->reference, "Surface file to compare with");
    command.add_option("--units", options->units, "Unit of the files: mm, cm or m (default: mm)");
    command.add_flag("--json", options->json, "Print one JSON document");
}

void add_centerlines(CommandLine& line) {
    const auto options = std::make_shared<CenterlineOptions>();
    CLI::App& command =
        add_command(line, "centerlines", "Find the vessel tree's centerlines and radii",
                    [options, &line] { return find_centerlines(*options, line.progress), 0; });
    command.add_option("SURFACE", options->surface, "Surface file")->required();
    command.add_option("OUT.vtp", options->out, "Polylines with MaximumInscribedSphereRadius")
        ->required();
    command.add_option("--units", options->units, "Unit of the file: mm, cm or m (default: mm)");
    command.add_flag("--json", options->json, "Print nodes and branches as one JSON document");
}

void add_phantom(CommandLine& line) {
    const auto options = std::make_shared<PhantomOptions>();
    CLI::App& command =
        add_command(line, "phantom", "Write a phantom's image, mask and exact surface",
                    [options, &line] { return write_phantom(*options, line.progress), 0; });
    command.add_option("NAME", options->name, "One of " + joined(phantom_names()))->required();
    command.add_option("--out", options->out, "Folder; made if it is not there")->required();
}

void set_up(CommandLine& line) {
    line.app.footer(kFooter);
    line.app.set_version_flag("--version", "vesselbench " + version(),
                              "Print the version and exit");
    line.app.set_help_flag("-h,--help", "Print this help and exit");
    line.app.failure_message(CLI::FailureMessage::simple);
    line.app.require_subcommand(0, 1);
    add_measure(line);
    add_centerlines(line);
    add_operations(line);
    add_phantom(line);
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    const std::vector<std::string> names = command_names(app);
    const std::string name = argv[1];
    if (std::ranges::find(names, name) != names.end()) return;
    throw UsageError("there is no command '" + name + "' in this version" +
                     did_you_mean(name, names) + " (the commands are " + joined(names) + ")");
}

/// The command whose arguments were wrong: its help is what the user needs.
std::string help_hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    return " (see 'vesselbench " + command + "--help')";
}

}  // namespace

int run_command_line(int argc, char** argv, const Progress& progress) {
    CommandLine line(progress);
    set_up(line);
    refuse_unknown_command(line.app, argc, argv);
    try {
        line.app.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        return line.app.exit(done, std::cout, std::cerr);
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what() + help_hint(line.app));
    }
    if (!line.command) {
        std::cerr << line.app.help();
        throw UsageError("this version has no window yet: name a command");
    }
    return line.command();
}

}  // namespace vesselbench
