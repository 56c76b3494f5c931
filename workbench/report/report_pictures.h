#pragma once

#include <cstdint>
#include <vector>

#include "geometry/surface.h"
#include "workbench/report/report_html.h"

namespace vesselbench {

/// The surface from three sides, and coloured by its deviation from the source (blue inside, red
/// outside of it). Empty where there is no usable OpenGL.
/// \param source may be null
/// \param comparable 1 at the vertices that have a counterpart in the source, #V; the others
/// (clipped
///        and extruded ends) stay white
[[nodiscard]] std::vector<ReportPicture> report_pictures(
    const Surface& surface, const Surface* source, const std::vector<std::uint8_t>& comparable);

}  // namespace vesselbench
