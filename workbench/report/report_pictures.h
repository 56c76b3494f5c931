#pragma once

#include <vector>

#include "geometry/surface.h"
#include "workbench/report/report_html.h"

namespace vesselbench {

/// The surface from three sides, and coloured by its deviation from the source (blue inside, red
/// outside of it). Empty where there is no usable OpenGL.
/// \param source may be null
[[nodiscard]] std::vector<ReportPicture> report_pictures(const Surface& surface,
                                                         const Surface* source);

}  // namespace vesselbench
