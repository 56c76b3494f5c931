#include "workbench/commands/command_line.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

#include "geometry/formats/centerline_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/case/version.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

namespace {

constexpr const char* kDescription =
    "vesselbench turns vessel images and raw vessel surfaces into CFD models and print models.";

/// What `prepare` writes for the purposes with products of their own.
std::string product_lines() {
    std::string lines;
    for (const Purpose& purpose : purposes())
        if (!purpose.products.empty())
            lines += "  for " + purpose.name + ": " + joined(product_names(purpose.name)) + "\n";
    return lines;
}

/// "flow simulation (cfd), ..., or surgery simulation (simulation)"
std::string purposes_help() {
    std::string text;
    for (const Purpose& purpose : purposes())
        text += (text.empty()                     ? ""
                 : &purpose == &purposes().back() ? ", or "
                                                  : ", ") +
                purpose.help;
    return text;
}

std::string prepare_footer() {
    return input_formats_text() +
           "\nA case is a folder with case.json. --set may be repeated; openfoam.flow=1.5 and the "
           "like\n"
           "change the flow (density, viscosity, flow, profile, iterations, residual, processes).\n"
           "OUT gets project.vbench, report.json, report.html and\n" +
           product_lines() +
           "\n"
           "  vesselbench prepare aorta.stl --for cfd --out aorta\n"
           "  vesselbench prepare scan.nrrd --for rp --set extract-surface.threshold=300 --out "
           "print";
}

std::string export_footer() {
    return "Formats by suffix, with the unit of length:\n" + export_formats_text() +
           "OpenFOAM takes --set openfoam.density, viscosity, flow, profile, iterations, "
           "residual,\n"
           "processes; --set may be repeated.";
}

constexpr const char* kChangeFooter =
    "Later edits become pending: they run again when their result is shown, exported or built\n"
    "upon. 'undo' reverts the change.";

constexpr const char* kPictureFooter =
    "Patient coordinates are LPS: y points backwards, z to the head. --view 0,1,0 looks from the\n"
    "front, --view=-1,0,0 from the left, --view 0,0,-1 from above.\n\n"
    "  vesselbench picture smooth.vtp deviation.png --reference raw.vtp --full-colour 0.5\n"
    "  vesselbench picture smooth.vtp weights.png --colour smoothing_weight";

std::string suggest_footer() {
    return "Each suggestion balances low curvature (smooth) against distance and volume (accurate) "
           "by\ntau; the rows below the first one are for a low, medium and high tau. For\n" +
           joined(searched_operations(counts_triangles), " and ") +
           ", the number of triangles replaces the curvature.\n\n  vesselbench suggest "
           "aorta.vbench --filter laplace --tau 0.4\n  vesselbench suggest aorta.vbench "
           "staircase=true\n  vesselbench suggest aorta.vbench --operation decimate";
}

std::string quality_footer() {
    return "Graphs and bars start from the given arguments of the operation (or its defaults) and "
           "change\none parameter at a time. Errors and volumes are relative to those of a strong "
           "change: for\n" +
           joined(searched_operations(searches_filter), " and ") +
           ", 50 iterations of Laplace with lambda 1. Curvature ranges from 100 % for the "
           "original\nto 0 % for the strong change.\n\n  vesselbench quality aorta.stl --out "
           "graphs.svg --out bars.svg --out gallery.png\n  vesselbench quality aorta.stl "
           "--operation remesh --out graphs.svg";
}

/// "a, b or c"
std::string alternatives(const std::vector<std::string>& names) {
    if (names.size() < 2) return joined(names);
    return joined(std::span(names).first(names.size() - 1)) + " or " + names.back();
}

/// What arguments make of a search: "for smooth, staircase=true keeps its thresholds, which follow
/// from the image".
std::string search_hints() {
    std::string text;
    for (const std::string& name : searched_operations())
        if (const std::string& hint = find_operation(name).search.hint; !hint.empty())
            text += "; for " + name + ", " + hint;
    return text;
}

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 the operation could not be done, 2 wrong usage, 3 the input is "
    "bad.\nSee 'vesselbench COMMAND --help' for a command, 'vesselbench operations' for the "
    "operations.";

/// The parser, and the command it found.
struct CommandLine {
    explicit CommandLine(std::stop_token on)
        : stop(std::move(on)), progress(console_progress(stop)) {}

    CLI::App app{kDescription, "vesselbench"};
    std::stop_token stop;
    Progress progress;
    std::function<int()> command;
    WindowOptions window;
};

void show_window(const CommandLine& line) {
    if (line.window.screenshot.empty())
        open_window(line.window, line.stop);
    else
        draw_screenshot(line.window);
}

CLI::App& add_command(CommandLine& line, const std::string& name, const std::string& summary,
                      std::function<int()> command) {
    CLI::App& added = *line.app.add_subcommand(name, summary);
    added.callback([&line, run = std::move(command)] { line.command = run; });
    return added;
}

void add_project(CLI::App& command, std::string& project) {
    command.add_option("PROJECT", project, "Project file (.vbench)")->required()->type_name("");
}

void add_json(CLI::App& command, bool& json, const char* help = "Print one JSON document") {
    command.add_flag("--json", json, help);
}

void add_operations(CommandLine& line) {
    const auto options = std::make_shared<OperationsOptions>();
    CLI::App& command = add_command(line, "operations", "List the operations and their parameters",
                                    [options] { return list_operations(*options), 0; });
    command.add_option("NAME", options->name, "Explain this operation only")->type_name("");
    add_json(command, options->json);
    command.add_flag("--markdown", options->markdown, "Print the page docs/operations.md")
        ->group("");
}

void add_apply(CommandLine& line) {
    const auto options = std::make_shared<ApplyOptions>();
    CLI::App& command =
        add_command(line, "apply", "Run an operation on a project, as an edit that can be undone",
                    [options, &line] { return apply_operation(*options, line.progress), 0; });
    add_project(command, options->project);
    command.add_option("OPERATION", options->operation, "Its name, as listed by 'operations'")
        ->required()
        ->type_name("");
    command
        .add_option("parameter=value", options->arguments,
                    "Its arguments; see 'vesselbench operations OPERATION'")
        ->type_name("");
    command
        .add_option("--variant", options->variant,
                    "Variant for edits of steps 6-8: cfd, rp or a name")
        ->capture_default_str()
        ->type_name("NAME");
    command
        .add_option("--step", options->step,
                    "Step the edit belongs to (default: the operation's usual step)")
        ->type_name("STEP");
    command.add_option("--author", options->author, "Author of the edit (default: login name)")
        ->type_name("NAME");
    command.add_option("--note", options->note, "Reason, in your own words")->type_name("WORDS");
    add_json(command, options->json, "Print the edit as one JSON document");
}

void add_edit(CLI::App& command, std::int64_t& edit) {
    command.add_option("EDIT", edit, "Its number, as 'log' lists it")->required()->type_name("");
}

void add_change_and_remove(CommandLine& line) {
    const auto changed = std::make_shared<ChangeOptions>();
    CLI::App& change =
        add_command(line, "change", "Run an earlier edit with other arguments",
                    [changed, &line] { return change_edit(*changed, line.progress), 0; });
    add_project(change, changed->project);
    add_edit(change, changed->edit);
    change
        .add_option("parameter=value", changed->arguments,
                    "Arguments to replace; the others stay as they were given")
        ->type_name("");
    change.add_option("--author", changed->author, "Who makes the change (default: login name)")
        ->type_name("NAME");
    change.add_option("--note", changed->note, "Reason, in your own words (default: as it was)")
        ->type_name("WORDS");
    add_json(change, changed->json, "Print the edit as one JSON document");
    change.footer(kChangeFooter);
    const auto removed = std::make_shared<RemoveOptions>();
    CLI::App& remove = add_command(line, "remove", "Leave an edit out",
                                   [removed] { return remove_edit(*removed), 0; });
    add_project(remove, removed->project);
    add_edit(remove, removed->edit);
    add_json(remove, removed->json);
    remove.footer(kChangeFooter);
}

void add_note(CommandLine& line) {
    const auto options = std::make_shared<NoteOptions>();
    CLI::App& command = add_command(line, "note", "Write a note on an edit, or remove it",
                                    [options] { return note_edit(*options), 0; });
    add_project(command, options->project);
    add_edit(command, options->edit);
    command.add_option("WORDS", options->words, "The note (default: none)")->type_name("");
    add_json(command, options->json);
}

void add_log(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    CLI::App& command =
        add_command(line, "log", "List steps, edits, authors, and what each edit changed",
                    [options] { return show_log(*options), 0; });
    add_project(command, options->project);
    add_json(command, options->json);
}

void add_undo_and_redo(CommandLine& line) {
    const auto options = std::make_shared<StepBackOptions>();
    CLI::App& undo = add_command(line, "undo", "Return to the state before an edit",
                                 [options] { return undo_edit(*options), 0; });
    add_project(undo, options->project);
    undo.add_option("EDIT", options->edit, "Return to before this edit (default: the last one)")
        ->type_name("");
    add_json(undo, options->json);
    CLI::App& redo = add_command(line, "redo", "Redo an edit that was undone",
                                 [options] { return redo_edit(*options), 0; });
    add_project(redo, options->project);
    redo.add_option("EDIT", options->edit, "Redo up to this edit (default: one state)")
        ->type_name("");
    add_json(redo, options->json);
}

void add_replay(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    CLI::App& command = add_command(
        line, "replay", "Run every edit again and compare with the stored results, bit for bit",
        [options, &line] { return replay_project(*options, line.progress) ? 0 : 1; });
    add_project(command, options->project);
    add_json(command, options->json);
}

void add_compact(CommandLine& line) {
    const auto options = std::make_shared<LogOptions>();
    CLI::App& command =
        add_command(line, "compact",
                    "Make a project smaller: drop results of undone edits, which can be computed "
                    "again; no edit is lost",
                    [options] {
                        compact(*options);
                        return 0;
                    });
    add_project(command, options->project);
    add_json(command, options->json);
}

void add_input(CLI::App& command, InputArguments& input) {
    command
        .add_option("INPUT", input.input,
                    "A surface, an image, a folder of DICOM slices, or a case folder")
        ->required()
        ->type_name("");
    command.add_option("--mask", input.mask, "Segmentation of the image, on the same grid")
        ->type_name("FILE");
    command
        .add_option(
            "--units", input.units,
            "Unit of the file: mm, cm or m (default: as stated in it, or the only one in which "
            "it is a vessel)")
        ->type_name("UNIT");
}

void add_prepare(CommandLine& line) {
    const auto options = std::make_shared<PrepareArguments>();
    CLI::App& command =
        add_command(line, "prepare", "Make a CFD model or a print model from an image or a surface",
                    [options, &line] { return prepare_case(*options, line.progress), 0; });
    add_input(command, options->input);
    command.footer(prepare_footer());
    command.add_option("--for", options->purpose, "Purpose of the model: " + purposes_help())
        ->required()
        ->type_name(joined(purpose_names(), "|"));
    command.add_option("--recipe", options->recipe, "JSON list of operations to use instead")
        ->type_name("FILE");
    command.add_flag("--resume", options->resume,
                     "Go on in the folder's project after the last edit of the recipe");
    command
        .add_option("--set", options->settings,
                    "operation.parameter=value: change an argument of the recipe")
        ->allow_extra_args(false)
        ->type_name("OPERATION.PARAMETER=VALUE");
    command.add_option("--out", options->out, "Folder of the results; created if missing")
        ->required()
        ->type_name("FOLDER");
    add_json(command, options->json);
}

void add_new(CommandLine& line) {
    const auto options = std::make_shared<NewArguments>();
    CLI::App& command =
        add_command(line, "new", "Make a project from an image or a surface",
                    [options, &line] { return make_project(*options, line.progress), 0; });
    add_project(command, options->project);
    add_input(command, options->input);
    add_json(command, options->json);
}

void add_export(CommandLine& line) {
    const auto options = std::make_shared<ExportArguments>();
    CLI::App& command =
        add_command(line, "export", "Export the model to a file, or as an OpenFOAM case",
                    [options, &line] { return export_project(*options, line.progress), 0; });
    add_project(command, options->project);
    command
        .add_option("FILE", options->file,
                    "Its suffix determines the format; a folder: an OpenFOAM case")
        ->required()
        ->type_name("");
    command.footer(export_footer());
    command.add_option("--variant", options->variant, "Variant to write")
        ->capture_default_str()
        ->type_name("NAME");
    command
        .add_option("--set", options->settings,
                    "openfoam.parameter=value: change the flow of the case")
        ->allow_extra_args(false)
        ->type_name("OPERATION.PARAMETER=VALUE");
    add_json(command, options->json);
}

void add_measure(CommandLine& line) {
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App& command =
        add_command(line, "measure", "Measure a surface, optionally against a reference surface",
                    [options] { return measure_surface(*options), 0; });
    command.add_option("SURFACE", options->surface, "Surface file")->required()->type_name("");
    command.add_option("REFERENCE", options->reference, "Surface file to compare with")
        ->type_name("");
    command
        .add_option("--histogram", options->histogram,
                    "Count the vertices by their distance from the reference, in bins this wide")
        ->type_name("MM");
    command.add_option("--units", options->units, "Unit of the files: mm, cm or m (default: mm)")
        ->type_name("UNIT");
    add_json(command, options->json);
}

void add_picture(CommandLine& line) {
    const auto options = std::make_shared<PictureArguments>();
    CLI::App& command =
        add_command(line, "picture", "Draw a surface, or its deviation from a reference",
                    [options] { return draw_picture(*options), 0; });
    command.add_option("SURFACE", options->surface, "Surface file")->required()->type_name("");
    command.add_option("OUT.png", options->out, "The picture")->required()->type_name("");
    command
        .add_option("--reference", options->reference,
                    "Surface file to compare with: blue is inside it, red outside")
        ->type_name("FILE");
    command
        .add_option("--colour", options->colour,
                    "Vertex attribute to show with a scale, as smooth keep_weights=true adds it")
        ->type_name("NAME");
    command
        .add_option("--range", options->range,
                    "Values of the first and the last colour (default: of the attribute)")
        ->delimiter(',')
        ->expected(2)
        ->type_name("LOW,HIGH");
    command
        .add_option("--full-colour", options->full_colour,
                    "Deviation shown in full colour [mm] (default: 98 % of the vertices are below)")
        ->type_name("MM");
    command
        .add_option("--view", options->view,
                    "View direction (default: 0,1,0, from the patient's front)")
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z");
    command.add_option("--size", options->size, "Width and height [pixels]")
        ->capture_default_str()
        ->type_name("PIXELS");
    command.add_option("--units", options->units, "Unit of the files: mm, cm or m (default: mm)")
        ->type_name("UNIT");
    add_json(command, options->json);
    command.footer(kPictureFooter);
}

void add_subject(CLI::App& command, SubjectOptions& subject) {
    command.add_option("SOURCE", subject.source, "Project (.vbench) or surface file")
        ->required()
        ->type_name("");
    command
        .add_option("parameter=value", subject.arguments,
                    "Arguments of the operation, which are kept" + search_hints())
        ->type_name("");
    command
        .add_option("--operation", subject.operation,
                    "Operation: " + alternatives(searched_operations()) +
                        " (default: " + searched_operations().front() + ")")
        ->type_name("NAME");
    command
        .add_option(
            "--variant", subject.variant,
            std::string("Variant of a project, if the operation belongs to one (default: ") +
                kDefaultVariant + ")")
        ->type_name("NAME");
    const std::string filtering = alternatives(searched_operations(searches_filter));
    command
        .add_option("--filter", subject.filter,
                    "Filter of " + filtering + " (default: as in " + filtering + ")")
        ->type_name("NAME");
    command
        .add_option("--units", subject.units, "Unit of surface files: mm, cm or m (default: mm)")
        ->type_name("UNIT");
}

void add_suggest(CommandLine& line) {
    const auto options = std::make_shared<SuggestOptions>();
    CLI::App& command =
        add_command(line, "suggest",
                    "Suggest parameters of " + searched_operations().front() +
                        ", or another operation, for a surface",
                    [options, &line] { return suggest_parameters(*options, line.progress), 0; });
    add_subject(command, options->subject);
    command
        .add_option("--tau", options->tau, "Target, from 0 (accurate) to 1 (smooth; few triangles)")
        ->capture_default_str()
        ->type_name("TAU");
    command
        .add_option("--score", options->score,
                    "default, thesis (Eq. 6.6 as printed) or compact (few triangles)")
        ->capture_default_str()
        ->type_name("FORM");
    command
        .add_option("--search", options->search,
                    "automatic, coarse (laplace: steps of 0.1 and 5 iterations), exhaustive (0.05 "
                    "and 1) or pattern")
        ->capture_default_str()
        ->type_name("WAY");
    add_json(command, options->json);
    command.add_flag("--grid", options->grid, "With --json: also the measures of all coarse sets");
    command
        .add_option(
            "--truth", options->truth,
            "With --grid: distance of each set's result from this surface, the known true one")
        ->type_name("FILE");
    command.footer(suggest_footer());
}

void add_quality(CommandLine& line) {
    const auto options = std::make_shared<QualityOptions>();
    CLI::App& command =
        add_command(line, "quality",
                    "Draw the effect of the parameters of " + searched_operations().front() +
                        ", or another operation, on a surface",
                    [options, &line] { return draw_quality(*options, line.progress), 0; });
    add_subject(command, options->subject);
    command
        .add_option("--out", options->out,
                    "Output: an .svg gets graphs, or bars if its name contains that word; a .png "
                    "gets the gallery of three suggestions; may be repeated")
        ->allow_extra_args(false)
        ->type_name("FILE");
    command.add_option("--tau", options->tau, "Target of the suggestions in graphs and bars")
        ->capture_default_str()
        ->type_name("TAU");
    command.add_option("--sort", options->sort, "Bars by parameter or by measure")
        ->capture_default_str()
        ->type_name("ORDER");
    command
        .add_option("--at", options->at,
                    "Place magnified in the gallery [mm] (default: where the surface moves most)")
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z");
    add_json(command, options->json, "Print the data of the graphs as one JSON document");
    command.footer(quality_footer());
}

void add_centerlines(CommandLine& line) {
    const auto options = std::make_shared<CenterlineOptions>();
    CLI::App& command =
        add_command(line, "centerlines", "Find the vessel tree's centerlines and radii",
                    [options, &line] { return find_centerlines(*options, line.progress), 0; });
    command.add_option("SURFACE", options->surface, "Surface file")->required()->type_name("");
    command
        .add_option("OUT" + centerline_format().suffixes[0], options->out,
                    "Polylines with MaximumInscribedSphereRadius")
        ->required()
        ->type_name("");
    command.add_option("--units", options->units, "Unit of the file: mm, cm or m (default: mm)")
        ->type_name("UNIT");
    add_json(command, options->json, "Print nodes and branches as one JSON document");
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

void add_window(CommandLine& line) {
    CLI::App& command =
        add_command(line, "open", "Open a project, a surface, an image or a case in the window",
                    [&line] { return show_window(line), 0; });
    command.add_option("FILE", line.window.file, "What to open")->required()->type_name("");
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
    add_prepare(line);
    add_new(line);
    add_apply(line);
    add_change_and_remove(line);
    add_note(line);
    add_log(line);
    add_undo_and_redo(line);
    add_replay(line);
    add_compact(line);
    add_export(line);
    add_measure(line);
    add_picture(line);
    add_suggest(line);
    add_quality(line);
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

void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments.front().starts_with("-")) return;
    const std::vector<std::string> names = command_names(app);
    const std::string& name = arguments.front();
    if (std::ranges::find(names, name) != names.end()) return;
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

/// The command with wrong arguments: the user needs its help.
std::string help_hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    return " (see 'vesselbench " + command + "--help')";
}

}  // namespace

int run_command_line(int argc, char** argv, const std::stop_token& stop) {
    CommandLine line(stop);
    set_up(line);
    std::vector<std::string> arguments = arguments_of(argc, argv);
    refuse_unknown_command(line.app, arguments);
    std::ranges::reverse(arguments);  // as the parser wants them
    try {
        line.app.parse(arguments);
    } catch (const CLI::Success& done) {  // --help, --version
        return line.app.exit(done, std::cout, std::cerr);
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what() + help_hint(line.app));
    }
    if (!line.command) {
        show_window(line);
        return 0;
    }
    return line.command();
}

}  // namespace vesselbench
