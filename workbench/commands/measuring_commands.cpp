#include "workbench/commands/measuring_commands.h"

#include <memory>

#include "geometry/formats/centerline_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/colours/shown_measure.h"
#include "workbench/operations/table.h"
#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

namespace {

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

/// What arguments make of a search: "for smooth, staircase=true keeps its thresholds, beta_min and
/// alpha".
std::string search_hints() {
    std::string text;
    for (const std::string& name : searched_operations())
        if (const std::string& hint = find_operation(name).search.hint; !hint.empty())
            text += "; for " + name + ", " + hint;
    return text;
}

void add_measure(CommandLine& line) {
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App& command =
        add_command(line, "measure", "Measure a surface, optionally against a reference surface",
                    [options, &line] { return measure_surface(*options, line.progress), 0; });
    command.add_option("SURFACE", options->surface, "Surface file, or a project (.vbench)")
        ->required()
        ->type_name("");
    command.add_option("REFERENCE", options->reference, "Surface file to compare with")
        ->type_name("");
    command
        .add_option("--histogram", options->histogram,
                    "Count the vertices by their distance from the reference, in bins this wide")
        ->type_name("MM");
    add_variant(command, options->variant, "Variant of a project to measure");
    command
        .add_option("--units", options->units, "Unit of the files: mm, cm, m or um (default: mm)")
        ->type_name("UNIT");
    add_json(command, options->json);
}

void add_picture(CommandLine& line) {
    const auto options = std::make_shared<PictureArguments>();
    CLI::App& command =
        add_command(line, "picture", "Draw a surface, or its deviation from a reference",
                    [options] { return draw_picture(*options), 0; });
    command.add_option("SURFACE", options->surface, "Surface file, or a project (.vbench)")
        ->required()
        ->type_name("");
    command.add_option("OUT.png", options->out, "The picture")->required()->type_name("");
    command
        .add_option("--reference", options->reference,
                    "Surface file to compare with: blue is inside it, red outside")
        ->type_name("FILE");
    command
        .add_option("--colour", options->colour,
                    "Measure to show with a scale: " + surface_measure_names_text() +
                        ";\nor a vertex attribute, as smooth keep_weights=true adds it")
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
    add_variant(command, options->variant, "Variant of a project to draw");
    command.add_option("--size", options->size, "Width and height [pixels]")
        ->capture_default_str()
        ->type_name("PIXELS");
    command.add_flag("--any-name", options->any_name, "Write PNG, whatever OUT.png is called")
        ->group("");  // file managers choose names without a suffix
    command.add_flag("--transparent", options->transparent,
                     "Transparent background instead of white; a scale stays on white");
    command
        .add_option("--units", options->units, "Unit of the files: mm, cm, m or um (default: mm)")
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
    add_variant(command, subject.variant, "Variant of a project, if the operation belongs to one");
    const std::string filtering = alternatives(searched_operations(searches_filter));
    command
        .add_option("--filter", subject.filter,
                    "Filter of " + filtering + " (default: as in " + filtering + ")")
        ->type_name(kFilterValue);
    command
        .add_option("--units", subject.units,
                    "Unit of surface files: mm, cm, m or um (default: mm)")
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
    command
        .add_option("--units", options->units, "Unit of the file: mm, cm, m or um (default: mm)")
        ->type_name("UNIT");
    add_json(command, options->json, "Print nodes and branches as one JSON document");
}

}  // namespace

void add_measuring_commands(CommandLine& line) {
    add_measure(line);
    add_picture(line);
    add_suggest(line);
    add_quality(line);
    add_centerlines(line);
}

}  // namespace vesselbench
