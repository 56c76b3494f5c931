#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What the model's colours show.
enum class ColouringKind {
    Patches,
    Deviation,
    MeanCurvature,
    StaircaseWeight,
    NeighbourDistance,
    TriangleQuality,
    LocalRadius,
    TetrahedraQuality
};

/// Which values of a measure are its worst.
enum class WorstEnd { Largest, Least, FarthestFromZero };

/// A colouring as the window offers it.
struct ColouringInfo {
    ColouringKind kind = ColouringKind::Patches;
    const char* name = "";   ///< of items: "mean-curvature"
    const char* label = "";  ///< "Mean curvature"
    const char* unit = "";   ///< "1/mm"; empty for patches
    const char* help = "";
    WorstEnd worst = WorstEnd::Largest;
};

[[nodiscard]] std::span<const ColouringInfo> colourings();

[[nodiscard]] const ColouringInfo& colouring_info(ColouringKind kind);

/// Values at the ends of a colour map.
struct ValueRange {
    double least = 0.0, most = 1.0;

    bool operator==(const ValueRange&) const = default;
};

/// From the 2nd to the 98th percentile of the finite values, but never narrower than 2 % of their
/// size; 0 to 1 if there are none.
[[nodiscard]] ValueRange shown_range(std::vector<double> values);

struct ColourValues {
    ColouringKind kind = ColouringKind::Patches;
    std::vector<double> values;  ///< #V of the surface, or #cells; not-a-number: none
    ValueRange range;            ///< shown_range of the values
    /// By which the worst places are ranked, where many have the same value: of staircases, the
    /// change of orientation (thesis Eq. 5.4) [-]. Empty: by the values.
    std::vector<double> sharpness = {};
};

/// Why a scene cannot be coloured so; empty: it can.
[[nodiscard]] std::string why_no_colours(ColouringKind kind, const Scene& scene);

/// The values of a colouring, which may take seconds. Triangle quality is the least 2 r_in / r_out
/// of a vertex's triangles, staircase weights are those of `smooth` with its default thresholds,
/// tetrahedra's quality is each one's smallest dihedral angle.
/// \throw InvalidInput as why_no_colours, and for patches and deviation, which have no values here;
/// AlgorithmFailure if centerlines or the direction of the image stack cannot be found; Cancelled
[[nodiscard]] ColourValues colour_values(ColouringKind kind, const Scene& scene,
                                         const Progress& progress);

}  // namespace vesselbench
