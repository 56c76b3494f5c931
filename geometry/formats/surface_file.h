#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/formats/length_unit.h"
#include "geometry/formats/patient_axes.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A surface from a file, in millimetres and patient coordinates (LPS), with its provenance.
struct SurfaceFile {
    Surface surface;                           ///< [mm]; not repaired: use repair
    LengthUnit unit = LengthUnit::Millimetre;  ///< of the file
    std::string unit_reason;              ///< "stated in the file", "given", or the guess's reason
    std::string unit_doubt;               ///< two readings that are nearly as plausible, or empty
    PatientAxes axes = PatientAxes::Lps;  ///< of the file; the surface is in LPS
    std::vector<std::string> notes;       ///< ignored data and decisions
};

/// Reads a surface in a format of surface_formats(), chosen by the suffix. Parts named or numbered
/// in the file become patches: those named wall, inlet..., outlet..., cut... by their names;
/// unnamed flat ones become candidate openings ("cut_1" ...), all others belong to the wall.
/// \param unit of the file; none: as stated in the file, or guessed from the size
/// \param axes of the file; none: as stated in the file, else LPS
/// \throw InvalidInput for another suffix, a damaged file, NaN or infinite coordinates, no
/// triangles; the text names the file without its folder, the place and the remedy
/// \throw IoError if the file cannot be read
[[nodiscard]] SurfaceFile read_surface(const std::string& path,
                                       std::optional<LengthUnit> unit = std::nullopt,
                                       std::optional<PatientAxes> axes = std::nullopt);

/// Writes a surface [mm] in the format of the suffix, whole or not at all.
/// \throw UsageError for another suffix, InvalidInput if there is no triangle, IoError if the file
/// cannot be written, Cancelled
void write_surface(const Surface& surface, const std::string& path, const Progress& progress = {});

/// True if the file is a surface: by its suffix, and by its first bytes where image formats share
/// that suffix.
[[nodiscard]] bool holds_surface(const std::string& path);

}  // namespace vesselbench
