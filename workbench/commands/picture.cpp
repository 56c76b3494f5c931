#include "gpu/picture.h"

#include <cmath>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/formats/format.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "gpu/png.h"
#include "workbench/commands/commands.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/report/report_pictures.h"

namespace vesselbench {

namespace {

constexpr int kLargestSide = 8192;  ///< limit of gpu/picture.h

void check(const PictureArguments& arguments) {
    if (lower_suffix(arguments.out) != ".png")
        throw UsageError("OUT '" + arguments.out + "' does not end in .png");
    if (arguments.size < 1 || arguments.size > kLargestSide)
        throw UsageError("--size: " + std::to_string(arguments.size) +
                         " pixels are out of the range 1 to " + std::to_string(kLargestSide));
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

}  // namespace

void draw_picture(const PictureArguments& arguments) {
    check(arguments);
    const Vec3 view = view_of(arguments.view);
    PictureOptions options{
        .width = arguments.size, .height = arguments.size, .view = view, .up = upward_for(view)};
    const Surface surface = read_foreign_surface(arguments.surface, arguments.units);
    std::string legend = "patches in their colours";
    if (!arguments.reference.empty()) {
        const Surface reference = read_foreign_surface(arguments.reference, arguments.units);
        DeviationColours deviation =
            deviation_colours(surface, reference, {}, arguments.full_colour.value_or(0.0));
        legend = "deviation, " + deviation_legend(deviation.full_colour);
        options.vertex_colours = std::move(deviation.colours);
    }
    PendingFiles files;
    files.add_text(arguments.out, png(draw(surface, options)));
    files.commit();
    if (arguments.json)
        std::cout << nlohmann::ordered_json({{"file", arguments.out}, {"legend", legend}}).dump(2)
                  << "\n";
    else
        std::cout << "wrote " << arguments.out << ": " << legend << "\n";
}

}  // namespace vesselbench
