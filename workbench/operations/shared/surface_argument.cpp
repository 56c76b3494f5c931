#include "workbench/operations/shared/surface_argument.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "geometry/formats/length_unit.h"
#include "geometry/formats/surface_file.h"
#include "geometry/formats/unit_readings.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

Parameter units_parameter(Meaning meaning) {
    return {.name = "units",
            .type = ParameterType::Choice,
            .default_value = std::string("auto"),
            .help =
                "unit of the file's coordinates; auto: the unit stated in the file, or the only "
                "one in which it has the size of a vessel; guess: the likeliest one",
            .choices = {"auto", "guess", "mm", "cm", "m", "um"},
            .meaning = meaning};
}

Parameter space_parameter() {
    return {.name = "space",
            .type = ParameterType::Choice,
            .default_value = std::string("stated"),
            .help =
                "patient axes of the file's coordinates, which are turned to LPS; stated: "
                "those that the file states, as 3D Slicer writes them (SPACE=RAS), else lps",
            .choices = {"stated", "lps", "ras"},
            .use = Use::Rare};
}

namespace {

/// A warning if no vessel is as large as the surface in the given unit, but one is in another.
std::optional<Diagnostic> unlikely_unit(const SurfaceArgument& read, LengthUnit unit) {
    if (read.surface.empty() || is_vessel_sized(read.surface)) return std::nullopt;
    Positions raw = read.surface.points();
    for (Vec3& point : raw) point /= millimetres_per(unit);
    const UnitGuess guess = guess_length_unit(read.surface.with_positions(std::move(raw)));
    if (guess.unit == unit) return std::nullopt;
    return Diagnostic{.code = "unit-unlikely",
                      .words = {{"file", read.name},
                                {"units", read.units},
                                {"likely", to_string(guess.unit)},
                                {"reason", guess.reason}},
                      .remedies = {{.arguments = {{"units", to_string(guess.unit)}}}}};
}

/// \param doubt with the readings, each of which is an answer
Diagnostic unit_in_doubt(const std::string& operation, const std::string& doubt) {
    Diagnostic question{
        .code = "unit-in-doubt", .operation = operation, .words = {{"doubt", doubt}}};
    std::vector<std::string> options;
    for (const LengthUnit unit : units_read(doubt)) {
        question.remedies.push_back({.arguments = {{"units", to_string(unit)}}});
        options.push_back("--units " + to_string(unit));
    }
    question.words["options"] = enumerated(options, "or");
    return question;
}

/// None: as the file states it.
std::optional<PatientAxes> given_axes(const Arguments& arguments) {
    return axes_named(arguments.text("space"));
}

}  // namespace

SurfaceArgument read_surface_argument(const std::string& operation, const Arguments& arguments,
                                      Outcome& outcome) {
    const std::string path = arguments.text("file"), units = arguments.text("units");
    const bool open = units == "auto" || units == "guess";
    SurfaceFile file = read_surface(
        path, open ? std::nullopt : std::optional(length_unit_from(units)), given_axes(arguments));
    SurfaceArgument read{.surface = std::move(file.surface),
                         .name = std::filesystem::path(path).filename().string(),
                         .units = to_string(file.unit),
                         .unit_reason = file.unit_reason,
                         .turned = file.axes == PatientAxes::Ras,
                         .notes = std::move(file.notes)};
    outcome.resolved.set("units", read.units);
    outcome.resolved.set("space", to_string(file.axes));
    if (!open) {
        auto warning = unlikely_unit(read, file.unit);
        if (warning) outcome.warnings.push_back(std::move(*warning));
    }
    if (file.unit_doubt.empty()) return read;
    read.unit_doubt =
        read.name + " does not state its unit: " + file.unit_doubt + "; both can be a vessel";
    if (units == "auto") throw DiagnosedUsage(unit_in_doubt(operation, read.unit_doubt));
    outcome.warnings.push_back(
        {.code = "unit-guessed",
         .words = {{"file", read.name}, {"doubt", file.unit_doubt}, {"units", read.units}},
         .remedies = {{.arguments = {{"units", ""}}}}});
    return read;
}

}  // namespace vesselbench
