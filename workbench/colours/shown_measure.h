#pragma once

#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"
#include "workbench/report/colour_scale.h"

namespace vesselbench {

/// A measure of a surface's vertices as pictures and exported models show it.
struct ShownMeasure {
    std::string name;            ///< "local-radius", or of a vertex attribute
    std::string label;           ///< "Local radius"; of an attribute its name
    std::string unit;            ///< "mm"; empty: a plain number, or not known
    std::vector<double> values;  ///< #V; not a number: none
    ColourScale scale;           ///< of colourings() the window's, of attributes scale_for()
};

/// A vertex attribute of the surface, or else a measure of colourings() that vertices have; those
/// may take seconds.
/// \throw InvalidInput that lists the names if there is none of this name, or why the scene cannot
/// be measured so; what colour_values() throws
[[nodiscard]] ShownMeasure shown_measure(const Scene& scene, const std::string& name,
                                         const Progress& progress);

/// "Local radius [mm]"
[[nodiscard]] std::string measure_title(const ShownMeasure& measure);

/// The names of colourings() that shown_measure() takes, for help texts: "mean-curvature, ...".
[[nodiscard]] std::string measure_names_text();

/// The same for scenes of a surface alone, without neighbours.
[[nodiscard]] std::string surface_measure_names_text();

}  // namespace vesselbench
