#include "gpu/picture.h"

#include <cmath>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "geometry/formats/format.h"
#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "gpu/png.h"
#include "gpu/transparency.h"
#include "workbench/case/json_text.h"
#include "workbench/colours/shown_measure.h"
#include "workbench/commands/commands.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/project/project.h"
#include "workbench/report/report_pictures.h"
#include "workbench/session/session.h"

namespace vesselbench {

namespace {

constexpr int kLargestSide = 8192;  ///< limit of gpu/picture.h

void check(const PictureArguments& arguments) {
    if (!arguments.any_name && lower_suffix(arguments.out) != ".png")
        throw UsageError("OUT '" + arguments.out + "' does not end in .png");
    if (arguments.size < 1 || arguments.size > kLargestSide)
        throw UsageError("--size: " + std::to_string(arguments.size) +
                         " pixels are out of the range 1 to " + std::to_string(kLargestSide));
    if (!arguments.colour.empty() && !arguments.reference.empty())
        throw UsageError("--colour and --reference are two ways to colour: give one of them");
    if (!arguments.range.empty()) {
        if (arguments.colour.empty()) throw UsageError("--range needs --colour");
        if (!(std::isfinite(arguments.range[0]) && std::isfinite(arguments.range[1]) &&
              arguments.range[0] < arguments.range[1]))
            throw UsageError("--range: give two numbers, the smaller one first");
    }
    if (arguments.full_colour) {
        if (arguments.reference.empty())
            throw UsageError("--full-colour is a deviation and needs --reference");
        if (!(*arguments.full_colour > 0.0 && std::isfinite(*arguments.full_colour)))
            throw UsageError("--full-colour must be above 0 mm");
    }
}

Vec3 view_of(const std::vector<double>& numbers) {
    const Vec3 view(numbers.at(0), numbers.at(1), numbers.at(2));
    if (view.allFinite() && view.norm() > 0.0) return view.normalized();
    throw UsageError("--view has no direction: give three numbers x,y,z, not all of them 0");
}

ColourScale scale_of(const PictureArguments& arguments, const ShownMeasure& measure) {
    ColourScale scale = measure.scale;
    if (!arguments.range.empty()) {
        scale.least = arguments.range[0];
        scale.most = arguments.range[1];
    }
    return scale;
}

struct Drawn {
    Picture picture;
    std::string legend;
};

Drawn coloured(const Surface& surface, PictureOptions options, const PictureArguments& arguments) {
    if (!arguments.colour.empty()) {
        const ShownMeasure measure = shown_measure({.surface = surface}, arguments.colour, {});
        const ColourScale scale = scale_of(arguments, measure);
        options.vertex_colours = colours_of(measure.values, scale);
        const std::string title = measure_title(measure);
        return {with_scale(draw(surface, options), scale, title),
                title + " from " + formatted(scale.least, "%.3g") + " to " +
                    formatted(scale.most, "%.3g")};
    }
    if (arguments.reference.empty()) return {draw(surface, options), "patches in their colours"};
    DeviationColours deviation =
        deviation_colours(surface, read_foreign_surface(arguments.reference, arguments.units), {},
                          arguments.full_colour.value_or(0.0));
    options.vertex_colours = std::move(deviation.colours);
    return {draw(surface, options), "deviation, " + deviation_legend(deviation.full_colour)};
}

/// The file's bytes, and what its colours mean.
std::pair<std::string, std::string> drawn_file(const Surface& surface, PictureOptions options,
                                               const PictureArguments& arguments) {
    const Drawn on_white = coloured(surface, options, arguments);
    if (!arguments.transparent) return {png(on_white.picture), on_white.legend};
    options.background = Colour::Zero();
    const Drawn on_black = coloured(surface, options, arguments);
    return {png(without_background(on_black.picture, on_white.picture)), on_white.legend};
}

/// Of a project what its edits have made so far; none of them runs.
Surface shown_surface(const PictureArguments& arguments) {
    if (!is_project_file(arguments.surface))
        return read_foreign_surface(arguments.surface, arguments.units);
    Session session = Session::open(arguments.surface, {.find = find_operation});
    const std::shared_ptr<const Snapshot> state = session.snapshot();
    const std::string variant = variant_of(arguments.surface, arguments.variant, *state->history);
    const Scene scene = session.known_scene(state->history->current(), variant);
    if (scene.surface) return *scene.surface;
    throw InvalidInput(bare_name(arguments.surface) +
                       " has no surface: none of its edits has made one");
}

}  // namespace

void draw_picture(const PictureArguments& arguments) {
    check(arguments);
    const Vec3 view = view_of(arguments.view);
    const PictureOptions options{
        .width = arguments.size, .height = arguments.size, .view = view, .up = upward_for(view)};
    const auto [bytes, legend] = drawn_file(shown_surface(arguments), options, arguments);
    PendingFiles files;
    files.add_text(arguments.out, bytes);
    files.commit();
    if (arguments.json)
        std::cout << text_from_json(
                         nlohmann::ordered_json({{"file", arguments.out}, {"legend", legend}}), 2)
                  << "\n";
    else
        std::cout << "wrote " << arguments.out << ": " << legend << "\n";
}

}  // namespace vesselbench
