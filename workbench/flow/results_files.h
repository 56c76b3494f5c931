#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "workbench/flow/flow_results.h"
#include "workbench/report/report_html.h"

namespace vesselbench {

/// Names of the arrays in wall.vtp: of its triangles, and but for the vector of its points as well.
namespace wall_arrays {
inline constexpr const char* kShearVector = "wall_shear_stress_pa";
inline constexpr const char* kShear = "wall_shear_pa";
inline constexpr const char* kPressure = "pressure_pa";
inline constexpr const char* kOsi = "osi";  // this and the next two of a pulsatile flow
inline constexpr const char* kRrt = "rrt_per_pa";
inline constexpr const char* kEcap = "ecap_per_pa";
}  // namespace wall_arrays

/// Values of triangles at the vertices: means of their triangles, weighted by area.
[[nodiscard]] std::vector<double> values_at_vertices(const Surface& surface,
                                                     const std::vector<double>& values,
                                                     const std::vector<double>& areas);

/// Pictures of the wall coloured by wall shear stress, from 0 to its 99th percentile.
/// \throw GpuUnavailable without usable OpenGL
[[nodiscard]] std::vector<ReportPicture> shear_pictures(const FlowResults& results);

/// What was written, and what could not be.
struct WrittenResults {
    std::vector<std::string> names;    ///< of the files
    std::vector<Diagnostic> warnings;  ///< without OpenGL, why there are no pictures
};

/// Writes results.json, history.csv, methods.txt, wall.vtp and wall.glb (coloured by wall shear
/// stress) and pictures into a folder, all of them or none; and a section into the reports of the
/// preparation that the case is in, if it is in one.
/// \throw IoError, Cancelled
WrittenResults write_flow_results(const FlowResults& results, const std::filesystem::path& folder,
                                  const Progress& progress);

}  // namespace vesselbench
