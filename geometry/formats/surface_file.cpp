#include "geometry/formats/surface_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "geometry/formats/file_parts.h"
#include "geometry/formats/legacy_vtk.h"
#include "geometry/formats/obj.h"
#include "geometry/formats/off.h"
#include "geometry/formats/ply.h"
#include "geometry/formats/stl.h"
#include "geometry/formats/vtp.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

struct Format {
    const char* suffix;
    RawSurface (*read)(const std::string&);
    void (*write)(const Surface&, const std::string&);
};

constexpr Format kFormats[] = {{".stl", read_stl, write_stl}, {".ply", read_ply, write_ply},
                               {".obj", read_obj, write_obj}, {".off", read_off, write_off},
                               {".vtp", read_vtp, write_vtp}, {".vtk", read_legacy_vtk, nullptr}};

std::string suffix_of(const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suffix;
}

const Format* format_of(const std::string& path) {
    const std::string suffix = suffix_of(path);
    for (const Format& format : kFormats)
        if (suffix == format.suffix) return &format;
    return nullptr;
}

void scale(Surface& surface, double factor) {
    if (factor == 1.0) return;
    Positions scaled = surface.points();
    for (Vec3& p : scaled) p *= factor;
    surface = surface.with_positions(std::move(scaled));
}

}  // namespace

bool is_surface_file(const std::string& path) {
    return format_of(path) != nullptr;
}

SurfaceFile read_surface(const std::string& path, std::optional<LengthUnit> unit) {
    const Format* format = format_of(path);
    if (!format)
        throw InvalidInput(bare_name(path) +
                           ": surfaces are read from .stl, .ply, .obj, .off, .vtp "
                           "and .vtk files");
    RawSurface raw = format->read(path);
    if (raw.triangles.empty())
        throw InvalidInput(bare_name(path) + " holds no triangles" +
                           (raw.positions.empty() ? "" : ", only points") +
                           ": export it again as a surface");
    SurfaceFile file;
    file.notes = raw.notes;
    const std::optional<LengthUnit> stated = raw.unit;
    file.surface = surface_from(std::move(raw), file.notes);
    if (unit) {
        file.unit = *unit;
        file.unit_reason = "given";
    } else if (stated) {
        file.unit = *stated;
        file.unit_reason = "stated in the file";
    } else {
        const UnitGuess guess = guess_length_unit(file.surface);
        file.unit = guess.unit;
        file.unit_reason = guess.reason;
        file.unit_certain = guess.certain;
    }
    scale(file.surface, millimetres_per(file.unit));
    return file;
}

void write_surface(const Surface& surface, const std::string& path) {
    const Format* format = format_of(path);
    if (!format || !format->write)
        throw UsageError("'" + suffix_of(path) +
                         "' is no surface format that can be written: use "
                         ".stl, .ply, .obj, .off or .vtp");
    if (surface.empty()) throw InvalidInput("there are no triangles to write");
    format->write(surface, path);
}

}  // namespace vesselbench
