#include "workbench/operations/shared/surface_argument.h"

#include <filesystem>

#include "geometry/formats/surface_file.h"

namespace vesselbench {

Parameter units_parameter() {
    return {.name = "units",
            .type = ParameterType::Choice,
            .default_value = std::string("auto"),
            .help =
                "unit of the file's coordinates; auto: the unit stated in the file, or the one in "
                "which it has the size of a vessel",
            .choices = {"auto", "mm", "cm", "m"}};
}

SurfaceArgument read_surface_argument(const Arguments& arguments, Outcome& outcome) {
    const std::string path = arguments.text("file"), units = arguments.text("units");
    SurfaceFile file =
        read_surface(path, units == "auto" ? std::nullopt : std::optional(length_unit_from(units)));
    SurfaceArgument read{.surface = std::move(file.surface),
                         .name = std::filesystem::path(path).filename().string(),
                         .units = to_string(file.unit),
                         .unit_reason = file.unit_reason,
                         .notes = std::move(file.notes)};
    outcome.resolved.set("units", read.units);
    if (!file.unit_certain)
        outcome.warnings.push_back(read.name + ": the unit is uncertain (" + file.unit_reason +
                                   "); give units=mm, cm or m if it is wrong");
    return read;
}

}  // namespace vesselbench
