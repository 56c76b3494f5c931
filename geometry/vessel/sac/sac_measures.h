#pragma once

#include <string>

#include "geometry/vessel/sac/sac_part.h"

namespace vesselbench {

/// Figures of an aneurysm's sac. Lengths [mm], areas [mm^2], volumes [mm^3].
///
/// Sources: [Ma] Ma, Harbaugh and Raghavan, "Three-dimensional geometrical characterization of
/// cerebral aneurysms", Ann Biomed Eng 32, 2004; [Raghavan] Raghavan, Ma and Harbaugh, "Quantified
/// aneurysm shape and rupture risk", J Neurosurg 102, 2005; [Dhar] Dhar et al., "Morphology
/// parameters for intracranial aneurysm rupture risk assessment", Neurosurgery 63, 2008.
struct SacMeasures {
    double dome_area = 0.0;  ///< of the wall beyond the neck's plane
    double neck_area = 0.0;  ///< of the section by the plane
    double volume = 0.0;     ///< between wall and plane
    double neck_diameter =
        0.0;                  ///< twice the mean distance of the outline from its centroid [Dhar]
    double neck_width = 0.0;  ///< largest distance of two points of the outline
    double neck_hydraulic = 0.0;  ///< 4 area / perimeter [Raghavan]
    double height = 0.0;          ///< largest distance from the neck's plane [Raghavan]
    double length = 0.0;  ///< largest distance from the neck's centroid [Dhar: maximum height]
    double width = 0.0;  ///< largest hydraulic diameter of sections parallel to the neck [Raghavan]
    double diameter = 0.0;           ///< largest distance of two points of the wall
    double aspect_ratio = 0.0;       ///< height / neck_diameter [-] [Dhar]
    double size_ratio = 0.0;         ///< length / parent_diameter [-] [Dhar]; 0 without a parent
    double bottleneck_factor = 0.0;  ///< width / neck_hydraulic [-] [Raghavan]
    double bulge_location = 0.0;     ///< distance of the widest section / height [-] [Raghavan]
    double undulation = 0.0;         ///< 1 - volume / that of the convex hull [-] [Raghavan]
    double ellipticity = 0.0;  ///< 1 - (18 pi)^(1/3) V^(2/3) / S of the convex hull [-] [Raghavan]
    double nonsphericity = 0.0;    ///< the same of the sac itself [-] [Raghavan]
    double parent_diameter = 0.0;  ///< of the vessel that carries the sac
};

/// \param parent_diameter [mm]; 0: unknown
[[nodiscard]] SacMeasures measure_sac(const SacPart& sac, double parent_diameter);

/// True if a plane hardly is a neck's: its outline is long for its area, as where it cuts a vessel
/// lengthwise, or wall lies far beside it, as where other vessels were cut off with the sac. The
/// limits were chosen on docs/science/sacs.md's cases.
[[nodiscard]] bool neck_in_doubt(const SacMeasures& measures);

/// The reasons: "its outline is long for its area"; empty: it is not in doubt.
[[nodiscard]] std::string why_neck_in_doubt(const SacMeasures& measures);

}  // namespace vesselbench
