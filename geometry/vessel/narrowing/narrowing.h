#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/tree/wall_rings.h"

namespace vesselbench {

/// What counts as a narrowing: what is deeper than both.
struct NarrowingParameters {
    double least_share = 0.2;  ///< of the expected radius [-], in (0, 1)
    double resolution = 0.0;   ///< of the surface: the longest edge of the image's voxels [mm]; 0:
                               ///< the mean edge of its triangles
};

/// A stretch of a branch whose wall is nearer to its axis than its neighbourhood lets expect. An
/// artefact of the image or a pathology: only an expert, or the image, can say.
struct Narrowing {
    std::size_t branch = 0;        ///< of the graph
    double from = 0.0, to = 0.0;   ///< arc length from the branch's start node [mm]
    double deepest = 0.0;          ///< arc length of the place [mm]
    Vec3 place = Vec3::Zero();     ///< on the centerline, where the share is largest [mm]
    double expected_radius = 0.0;  ///< there [mm]
    double found_radius = 0.0;     ///< of the circle of the section's area there [mm]
    double certainty = 0.0;        ///< that the surface is narrower there than beside it, in [0, 1]

    /// Of the radius that is missing [mm].
    [[nodiscard]] double depth() const { return expected_radius - found_radius; }

    /// The same of the expected radius [-].
    [[nodiscard]] double share() const { return depth() / expected_radius; }
};

/// The narrowings of all branches, the deepest share first. Furcations, ends and bulges are left
/// out, and so is a narrowing that takes more than half of its branch.
/// Source: thesis 4.2.4; expectation as in expected_radii.h.
/// \param graph the surface's centerlines
/// \throw InvalidInput if a parameter is out of range; Cancelled
[[nodiscard]] std::vector<Narrowing> find_narrowings(const Surface& surface,
                                                     const CenterlineGraph& graph,
                                                     const NarrowingParameters& parameters = {},
                                                     const Progress& progress = {});

/// The stretch of one branch as a narrowing, whatever its depth; the expectation comes from the
/// branch outside it. None where nothing is to compare with, or no whole section is within it.
/// \param rings of the branch (wall_rings) \param from, to arc length, from < to [mm]
[[nodiscard]] std::optional<Narrowing> narrowing_between(const std::vector<WallRing>& rings,
                                                         std::size_t branch, double from,
                                                         double to);

/// What the radius is along a branch and what is expected.
struct RadiusCourse {
    std::vector<double> along;     ///< arc length, ascending [mm]
    std::vector<double> found;     ///< mean over three rings [mm]
    std::vector<double> expected;  ///< [mm]
    std::vector<double> scatter;   ///< as in ExpectedRadii [-]

    /// Linear between the places, constant beyond the ends [mm].
    [[nodiscard]] double found_at(double s) const;
    [[nodiscard]] double expected_at(double s) const;
};

/// \param from, to a stretch that does not count for the expectation [mm]; from > to: none
/// \return empty if too few whole sections count
[[nodiscard]] RadiusCourse radius_course(const std::vector<WallRing>& rings, double from = 1.0,
                                         double to = 0.0);

}  // namespace vesselbench
