#include "workbench/operations/shared/surface_argument.h"

#include <filesystem>
#include <utility>

#include "geometry/formats/length_unit.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

Parameter units_parameter(Meaning meaning) {
    return {.name = "units",
            .type = ParameterType::Choice,
            .default_value = std::string("auto"),
            .help =
                "unit of the file's coordinates; auto: the unit stated in the file, or the only "
                "one in which it has the size of a vessel; guess: the likeliest one",
            .choices = {"auto", "guess", "mm", "cm", "m"},
            .meaning = meaning};
}

namespace {

/// A warning if the file's coordinates have a vessel's size in another unit only; else empty.
std::string unlikely_unit_text(const SurfaceArgument& read, LengthUnit unit) {
    if (read.surface.empty()) return "";
    Positions raw = read.surface.points();
    for (Vec3& point : raw) point /= millimetres_per(unit);
    const Surface in_file = read.surface.with_positions(std::move(raw));
    const UnitGuess guess = guess_length_unit(in_file);
    if (guess.unit == unit) return "";
    const std::string text = read.name + " is read in " + read.units + ", as asked, but ";
    if (guess.doubt.empty())
        return text + "has a vessel's size in " + to_string(guess.unit) + " only (" + guess.reason +
               ")";
    const bool possible = guess_length_unit(in_file, unit).unit == unit;
    return possible ? "" : text + guess.doubt;
}

}  // namespace

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
    if (!open) {
        const std::string text = unlikely_unit_text(read, file.unit);
        if (!text.empty()) outcome.warnings.push_back(text);
    }
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
