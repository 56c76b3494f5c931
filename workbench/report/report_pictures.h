#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/picture.h"
#include "gpu/role_colours.h"
#include "workbench/report/colour_scale.h"
#include "workbench/report/report_html.h"
#include "workbench/report/source_parts.h"

namespace vesselbench {

/// What the model is compared with in pictures.
struct PictureSource {
    const Surface& surface;
    /// 1 at the model's vertices that have a counterpart in the source, #V; the others (clipped and
    /// extruded ends) are white.
    std::vector<std::uint8_t> comparable;
    std::vector<ClosedEnd> closed;  ///< ends that were left closed
};

/// A vessel end in pictures: a dot in its role's colour, with its number beside it.
struct EndMark {
    Vec3 place;      ///< [mm]
    int number = 0;  ///< 0: it has none
    ShownRole role = ShownRole::Outlet;
};

/// Marks ends in a square picture.
/// \param options of the picture, with its half height
/// \param centre of the surface's bounds [mm] \param digit height of a number [pixels]
void draw_marks(Picture& picture, std::span<const EndMark> ends, const PictureOptions& options,
                const Vec3& centre, double digit);

/// The surface from three sides, with its ends, and coloured by its deviation from the source (blue
/// inside, red outside of it); the source with its closed ends and lost parts in colours of their
/// own, if there are any. \throw GpuUnavailable without usable OpenGL
[[nodiscard]] std::vector<ReportPicture> report_pictures(const Surface& surface,
                                                         const std::optional<PictureSource>& source,
                                                         std::span<const EndMark> ends = {});

/// The surface from the same sides, coloured by a measure of its vertices, with its scale.
/// \param values #V \param title of the scale and of the pictures: "Wall shear stress [Pa]"
/// \throw GpuUnavailable without usable OpenGL
[[nodiscard]] std::vector<ReportPicture> measure_pictures(const Surface& surface,
                                                          const std::vector<double>& values,
                                                          const ColourScale& scale,
                                                          const std::string& title);

/// The deviation shown in full colour [mm]: 98 % are below it; 1 if there is none.
[[nodiscard]] double deviation_of_full_colour(std::vector<double> deviations);

/// Blue to red for deviations [mm] from -full_colour to it.
[[nodiscard]] std::vector<Colour> colours_of(const std::vector<double>& deviations,
                                             double full_colour);

/// Vertex colours of a surface's deviation from another one, blue inside, red outside of it.
struct DeviationColours {
    std::vector<Colour> colours;  ///< #V
    double full_colour = 0.0;     ///< the deviation shown in full colour [mm]
};

/// \param comparable as for PictureSource; empty: all vertices
/// \param full_colour [mm]; 0: 98 % of the comparable vertices are below
/// \throw InvalidInput if the source has no triangle
[[nodiscard]] DeviationColours deviation_colours(const Surface& surface, const Surface& source,
                                                 const std::vector<std::uint8_t>& comparable = {},
                                                 double full_colour = 0.0);

/// The meaning of the colours: "blue 0.5 mm inside, red outside".
[[nodiscard]] std::string deviation_legend(double full_colour);

}  // namespace vesselbench
