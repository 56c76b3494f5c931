#include "workbench/commands/preparing_commands.h"

#include <memory>

#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/products.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

namespace {

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
           "change the flow (flow, outlets, profile, density, viscosity, viscosity_model, "
           "iterations ...).\n"
           "OUT gets project.vbench, report.json, report.html and\n" +
           product_lines() +
           "\n"
           "  vesselbench prepare aorta.stl --for cfd --out aorta\n"
           "  vesselbench prepare scan.nrrd --for rp --set extract-surface.threshold=300 --out "
           "print";
}

void add_input_options(CLI::App& command, InputArguments& input) {
    command
        .add_option("--mask", input.mask,
                    "Segmentation of the image: labels or a level set; a smaller or turned grid of "
                    "the same lattice is taken as it is, another one is resampled by shape")
        ->type_name("FILE");
    command
        .add_option("--label", input.label,
                    "Segments of the mask, else of the label map INPUT, that are the vessel: names "
                    "or numbers, as artery or 1,2, or all. Without it, a list of them is printed "
                    "if there are several, and nothing is made")
        ->type_name("NAME|N,..");
    command
        .add_option(
            "--units", input.units,
            "Unit of the file: mm, cm, m or um (default: as stated in it, or the only one in which "
            "it is a vessel)")
        ->type_name("UNIT");
}

void add_input_argument(CLI::App& command, InputArguments& input) {
    command
        .add_option("INPUT", input.input,
                    "A surface, an image, a folder of DICOM slices, a case folder, or the name of "
                    "a bundled\n"
                    "case: aneurysm")
        ->required()
        ->type_name("");
}

void add_input(CLI::App& command, InputArguments& input) {
    add_input_argument(command, input);
    add_input_options(command, input);
}

void add_mask_is(CLI::App& command, InputArguments& input) {
    command
        .add_option("--mask-is", input.mask_is,
                    "wall: the mask's surface, moved by the image where it has an edge within a "
                    "voxel (default for labels); region: the mask limits a threshold (default for "
                    "a level set, and with extract-surface.threshold, method or dilation)")
        ->check(CLI::IsMember({"wall", "region"}).description(""))
        ->type_name("wall|region");
}

void add_neighbours(CLI::App& command, InputArguments& input) {
    command
        .add_option("--neighbour", input.neighbours,
                    "A structure beside the vessel: a surface file, or a segment's name or labels "
                    "N,N of the label map; may be repeated. The report says how near it is, and "
                    "smoothing for "
                    "planning keeps that distance")
        ->allow_extra_args(false)
        ->type_name("FILE|NAME|N,N");
}

void add_names(CLI::App& command, std::string& author, std::string& input) {
    command.add_option("--author", author, "Author of the edits (default: login name)")
        ->type_name("NAME");
    command
        .add_option("--name", input,
                    "The input's name in reports and their titles, in place of those of files "
                    "(default: the file's); the project keeps it, and the files' names")
        ->type_name("NAME");
}

void add_end_options(CLI::App& command, EndArguments& ends) {
    const auto add = [&](const char* name, std::vector<std::string>& texts, const char* help) {
        command.add_option(name, texts, help)->allow_extra_args(false)->type_name("N|X,Y,Z");
    };
    add("--inlet", ends.inlets,
        "A vessel end where blood enters, by its number (see ends) or place; may be repeated");
    add("--open", ends.open,
        "Vessel ends that are opened: numbers N,N or a place; may be repeated");
    add("--close", ends.close, "Vessel ends that stay closed, likewise");
    command
        .add_option("--vessel", ends.vessel,
                    "vein: blood gathers from all other ends to the trunk, which is the outlet; "
                    "artery, portal: it enters at the trunk (default: as in an artery; asked where "
                    "a label, patch or file is named like a vein)")
        ->check(CLI::IsMember({"artery", "vein", "portal"}).description(""))
        ->type_name("artery|vein|portal");
    command.add_flag("--accept-doubts", ends.accept_doubts,
                     "Where the odds do not decide about a vessel end, take the likelier choice");
}

void add_prepare(CommandLine& line) {
    const auto options = std::make_shared<PrepareArguments>();
    CLI::App& command = add_command(
        line, "prepare", "Make a CFD model or a print model from an image or a surface",
        [options, &line] { return prepare_case(*options, line.progress, line.refused); });
    add_input_argument(command, options->input);
    command.footer(prepare_footer());
    add_purpose(command, options->purpose);
    add_case_options(command, *options);
    command
        .add_option("--refine", options->refinements,
                    "Finer triangles around a place, and finer cells behind them: "
                    "x,y,z:radius:edge in mm; may be repeated")
        ->allow_extra_args(false)
        ->type_name("X,Y,Z:R:E");
    command.add_flag(
        "--resume", options->resume,
        "Continue in the folder's project with the edits of the recipe that are missing");
    command.add_flag("--run", options->run,
                     "Solve the flow with OpenFOAM as well, as `run` does, and read its results");
    command
        .add_flag("--question", options->question,
                  "Where ends are in doubt, write what a batch asks with")
        ->group("");
    command.add_option("--out", options->out, "Folder of the results; created if missing")
        ->required()
        ->type_name("FOLDER");
    add_json(command, options->json);
}

void add_ends(CommandLine& line) {
    const auto options = std::make_shared<EndsOptions>();
    CLI::App& command = add_command(
        line, "ends", "List the vessel ends, and what prepare --for cfd would make of each",
        [options, &line] { return list_ends(*options, line.progress), 0; });
    add_input(command, options->input);
    add_mask_is(command, options->input);
    add_settings(command, options->settings);
    add_end_options(command, options->ends);
    command.add_option("--picture", options->picture, "Draw the vessels with the ends' numbers")
        ->type_name("FILE.png");
    add_json(command, options->json);
}

void add_new(CommandLine& line) {
    const auto options = std::make_shared<NewArguments>();
    CLI::App& command =
        add_command(line, "new", "Make a project from an image or a surface",
                    [options, &line] { return make_project(*options, line.progress), 0; });
    add_project(command, options->project);
    add_input(command, options->input);
    add_neighbours(command, options->input);
    add_names(command, options->author, options->name);
    add_json(command, options->json);
}

}  // namespace

void add_purpose(CLI::App& command, std::string& purpose) {
    command.add_option("--for", purpose, "Purpose of the model: " + purposes_help())
        ->required()
        ->transform(purpose_name)
        ->type_name(joined(purpose_names(), "|"));
}

void add_case_options(CLI::App& command, PrepareArguments& options) {
    add_input_options(command, options.input);
    add_mask_is(command, options.input);
    add_neighbours(command, options.input);
    command
        .add_option("--recipe", options.recipe,
                    "Operations to use instead of the default ones: a file, or a bundled recipe: " +
                        joined(bundled_recipe_names()))
        ->type_name(kRecipeValue);
    add_settings(command, options.settings);
    add_end_options(command, options.ends);
    add_names(command, options.author, options.name);
}

void add_preparing_commands(CommandLine& line) {
    add_prepare(line);
    add_ends(line);
    add_new(line);
}

}  // namespace vesselbench
