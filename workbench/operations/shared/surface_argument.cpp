#include "workbench/operations/shared/surface_argument.h"

#include <filesystem>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

Parameter units_parameter() {
    return {.name = "units",
            .type = ParameterType::Choice,
            .default_value = std::string("auto"),
            .help =
                "unit of the file's coordinates; auto: the unit stated in the file, or the only "
                "one in which it has the size of a vessel; guess: the likeliest one",
            .choices = {"auto", "guess", "mm", "cm", "m"}};
}

SurfaceArgument read_surface_argument(const Arguments& arguments, Outcome& outcome) {
    const std::string path = arguments.text("file"), units = arguments.text("units");
    const bool open = units == "auto" || units == "guess";
    SurfaceFile file =
        read_surface(path, open ? std::nullopt : std::optional(length_unit_from(units)));
    SurfaceArgument read{.surface = std::move(file.surface),
                         .name = std::filesystem::path(path).filename().string(),
                         .units = to_string(file.unit),
                         .unit_reason = file.unit_reason,
                         .notes = std::move(file.notes)};
    outcome.resolved.set("units", read.units);
    if (file.unit_doubt.empty()) return read;
    read.unit_doubt =
        read.name + " does not state its unit: " + file.unit_doubt + "; both can be a vessel";
    if (units == "auto")
        throw UsageError(read.unit_doubt + ". Give units=mm, cm or m (prepare and new: --units)");
    outcome.warnings.push_back(read.unit_doubt + ". It is read as " + read.units +
                               "; change the units of the edit if that is wrong");
    return read;
}

}  // namespace vesselbench
