#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/ends/image_box.h"
#include "geometry/vessel/ends/surface_ends.h"

namespace vesselbench {

/// Ends that were left open or named, from which on they are taken for all of them.
inline constexpr std::size_t kFewestCuts = 2;

/// How far the wall leans at most over a face that a plane may have cut, as a share of a right
/// angle [-].
inline constexpr double kMostLean = 0.2;

/// How a candidate for a vessel's end looks.
enum class EndKind {
    Blind,   ///< a tip of the lumen, or a branch without a line
    Rim,     ///< an open border of the surface
    Named,   ///< a cap with a label of the file
    Border,  ///< a cap where the image ends
    Face     ///< a planar face of the wall that `repair` has found
};

/// What is measured of a candidate for a vessel's end, once. Diameters are those of inscribed
/// spheres, but for `neck`.
struct EndProfile {
    double length = 0.0;    ///< of its own vessel, beyond its parent's inscribed spheres [mm]
    double diameter = 0.0;  ///< median along that length [mm]
    double inner = 0.0;     ///< mean along its third next to its parent [mm]; else `diameter`
    double widest = 0.0;    ///< along that length [mm]
    double neck = 1.0;      ///< a section's diameter over a smaller one nearer to the parent [-]
    double taper = 1.0;     ///< mean diameter of the outer third over that of the inner third [-]
    double parent = 0.0;    ///< of the widest other vessel at its furcation [mm]; 0: there is none
    std::vector<double> others;  ///< cubes of the diameters of the other vessels there [mm^3]
    double tree = 0.0;           ///< of the widest other vessel of the tree [mm]
    double across = 0.0;         ///< voxels of the image, or edges of the surface, across it [-]
    EndKind kind = EndKind::Blind;
    /// Cosine of the angle by which it turns from the vessel that it continues best [-]: a daughter
    /// goes on in its parent's direction, a bump or a sac of the wall stands across.
    double straight = 0.0;
    double closure = 0.0;    ///< of the circle with its rim's or cap's area [mm]; 0: it has none
    double cap_share = 1.0;  ///< of a cap: its diameter over its vessel's [-]
    double cap_rise = 90.0;  ///< of a cap: mean angle of the wall behind it and its plane [deg]
    /// Of an end that nobody named or left open: share of the flow through rims and named caps [-]
    double cut_beside = 0.0;
    /// Of the same: number of these rims and named caps, as far as a line leads to them
    std::size_t cuts_beside = 0;
    /// Of a closed end: sum of `upright` of the planar faces beside it, as far as a line leads to
    /// them [-]
    double faces_beside = 0.0;

    /// Somebody has left it open, or named it.
    [[nodiscard]] bool is_left_open() const {
        return kind == EndKind::Rim || kind == EndKind::Named;
    }

    /// Somebody, or the image's border, has cut a vessel there.
    [[nodiscard]] bool is_cut() const { return is_left_open() || kind == EndKind::Border; }

    /// Of a planar face of the wall [-]: 1 where the wall stands upright on it, as on one that a
    /// plane has cut; 0 where it leans by kMostLean or more, as into a flat place of a dome.
    [[nodiscard]] double upright() const;

    /// Another vessel at its furcation. \param course its diameter [mm]
    void add_other(double course) {
        parent = course > parent ? course : parent;
        others.push_back(course * course * course);
    }

    /// Sum of the others [mm^3].
    [[nodiscard]] double other_flow() const {
        return std::accumulate(others.begin(), others.end(), 0.0);
    }

    /// How much nearer its furcation comes to Murray's law by its flow [-]: a trunk is missing
    /// without it, and a sac disturbs.
    [[nodiscard]] double need() const;
};

/// Dimensionless, in the order of `kEndFeatures`.
inline constexpr std::array<std::string_view, 23> kEndFeatures = {
    "one",         "length",  "short",        "neck",        "beside_parent", "surplus",
    "beside_tree", "need",    "widening",     "taper",       "straight",      "across",
    "rim",         "border",  "border_share", "border_lean", "face",          "face_share",
    "face_lean",   "upright", "cut_beside",   "cuts_beside", "faces_beside"};

using EndFeatures = std::array<double, kEndFeatures.size()>;

[[nodiscard]] EndFeatures features_of(const EndProfile& profile);

/// What profiles are measured on.
struct EndScene {
    const Surface& surface;
    const CenterlineGraph& graph;
    std::optional<ImageBox> image;  ///< that the surface was made from
    bool border_cuts = false;       ///< as OpeningPlanOptions
};

/// Of all candidates for a vessel's end.
struct EndProfiles {
    std::vector<EndProfile> ends;   ///< by end
    std::vector<EndProfile> stubs;  ///< by blind branch without a line
};

/// \param ends as from find_surface_ends
/// \param stubs of the same lines
/// \throw Cancelled
[[nodiscard]] EndProfiles profiles_of(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                                      const std::vector<Stub>& stubs,
                                      const Progress& progress = {});

}  // namespace vesselbench
