#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A ball in which an operation may change the surface.
struct ChangeZone {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 0.0;         ///< [mm]
};

/// A vessel end that an operation says it takes away.
struct NamedLoss {
    Vec3 tip = Vec3::Zero();  ///< on the line of its vessel, or in the middle of its rim [mm]
    std::optional<Plane> plane = {};  ///< only what lies beyond goes; none: the whole branch
};

/// By how much a count may grow; less than 0: it may fall.
struct AllowedGrowth {
    int least = 0;
    int most = 0;
};

inline constexpr AllowedGrowth kAnyGrowth{std::numeric_limits<int>::min(),
                                          std::numeric_limits<int>::max()};
inline constexpr AllowedGrowth kAnyGain{0, std::numeric_limits<int>::max()};
inline constexpr AllowedGrowth kAnyLoss{std::numeric_limits<int>::min(), 0};

/// What an operation states that a run may change of the scene's surface. The session compares its
/// outcome with that and refuses what changes more, whoever asked for the run.
struct StatedChange {
    /// Outside of all of them, vertices keep their bits; none: it may act everywhere.
    std::optional<std::vector<ChangeZone>> zones = {};
    bool keeps_triangles = false;  ///< vertices move, and nothing else
    AllowedGrowth parts = {};      ///< connected ones
    AllowedGrowth handles = {};    ///< the genus
    AllowedGrowth rims = {};       ///< open ends and other holes
    double volume_lost = std::numeric_limits<double>::infinity();    ///< at most [mm^3]
    double volume_gained = std::numeric_limits<double>::infinity();  ///< at most [mm^3]
    /// The farthest from the new wall that wall may lie which is gone [mm]: a sac or a vessel's end
    /// that is lost lies farther away.
    double wall_lost = std::numeric_limits<double>::infinity();
    /// Besides, so many radii of the ball that touches the wall there from inside [-]: what makes a
    /// vessel thinner moves no wall as far as its line.
    double radii_lost = 0.0;
    std::vector<NamedLoss> named = {};  ///< ends that may go, however far
    bool keeps_walls_apart = false;     ///< no more triangles cross where it changed something
    /// Share of the edges where it moved wall along which it may fold the wall over [-]: folds are
    /// what turns a wall into rubble. Asked only if the triangles stay.
    double folded = 1.0;
    std::vector<Remedy> remedies = {};  ///< what to try if the outcome is refused
    /// What the operation's own figures hold against its outcome, which is refused for it.
    std::optional<Diagnostic> doubt = {};
};

}  // namespace vesselbench
