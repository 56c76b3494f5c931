#include "geometry/formats/surface_file.h"

#include "geometry/formats/file_parts.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/formats/unreadable_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// \param factors of x, y and z
void scale(Surface& surface, const Vec3& factors) {
    if (factors == Vec3::Ones()) return;
    Positions scaled = surface.points();
    for (Vec3& p : scaled) p = p.cwiseProduct(factors);
    surface = surface.with_positions(std::move(scaled));
}

/// The axes that the surface is read in, which a note says if they are not ours.
PatientAxes axes_of(const RawSurface& raw, std::optional<PatientAxes> given,
                    std::vector<std::string>& notes) {
    const PatientAxes axes = given.value_or(raw.axes.value_or(PatientAxes::Lps));
    if (axes == PatientAxes::Ras)
        notes.push_back(std::string("the coordinates are RAS (") +
                        (given ? "given" : "stated in the file") +
                        "): x and y were turned to LPS, as images have them");
    return axes;
}

std::map<std::string, std::string> words_of_empty(const std::string& path, const RawSurface& raw) {
    std::map<std::string, std::string> words = {{"file", bare_name(path)}};
    if (!raw.positions.empty()) words["content"] = "only points";
    return words;
}

}  // namespace

bool holds_surface(const std::string& path) {
    const SurfaceFormat* format = row_that_reads(surface_formats(), path);
    return format && content_fits(*format, path);
}

SurfaceFile read_surface(const std::string& path, std::optional<LengthUnit> unit,
                         std::optional<PatientAxes> axes) {
    refuse_special_file(path);
    const SurfaceFormat* format = row_that_reads(surface_formats(), path);
    if (!format)
        throw InvalidInput(bare_name(path) + ": surfaces are read from " +
                           enumerated(read_suffixes(surface_formats())) + " files");
    RawSurface raw = read_or_explain([&] { return format->read(path); });
    if (raw.triangles.empty())
        throw DiagnosedInput(
            {.code = "file-without-triangles", .words = words_of_empty(path, raw)});
    SurfaceFile file;
    file.notes = raw.notes;
    file.axes = axes_of(raw, axes, file.notes);
    const std::optional<LengthUnit> stated = raw.unit;
    const LengthUnit usual = raw.usual_unit.value_or(LengthUnit::Millimetre);
    file.surface = surface_from(std::move(raw), file.notes);
    if (unit) {
        file.unit = *unit;
        file.unit_reason = "given";
    } else if (stated) {
        file.unit = *stated;
        file.unit_reason = "stated in the file";
    } else {
        const UnitGuess guess = guess_length_unit(file.surface, usual);
        file.unit = guess.unit;
        file.unit_reason = guess.reason;
        file.unit_doubt = guess.doubt;
    }
    const double sign = file.axes == PatientAxes::Ras ? -1.0 : 1.0;
    scale(file.surface, millimetres_per(file.unit) * Vec3(sign, sign, 1.0));
    return file;
}

void write_surface(const Surface& surface, const std::string& path, const Progress& progress) {
    const SurfaceFormat* format = row_that_writes(surface_formats(), path);
    if (!format)
        throw UsageError("'" + lower_suffix(path) +
                         "' is not a surface format that can be written: use " +
                         enumerated(written_suffixes(surface_formats()), "or"));
    if (surface.empty()) throw InvalidInput("there are no triangles to write");
    format->write(surface, path, progress, {});
}

}  // namespace vesselbench
