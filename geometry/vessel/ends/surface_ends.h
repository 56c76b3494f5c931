#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// A border or a cap belongs to a tip within this many of the larger one's diameters [-].
inline constexpr double kEndReach = 1.5;

/// An end of a vessel: an open border, a cap, or the tip of a closed branch.
struct SurfaceEnd {
    Vec3 centre = Vec3::Zero();        ///< of its rim or cap; else the tip [mm]
    double diameter = 0.0;             ///< of the vessel there [mm]
    double closure = 0.0;              ///< of its rim or cap [mm]; 0: it has none
    std::optional<std::size_t> patch;  ///< its cap
    std::vector<VertexId> rim;         ///< its open border, as from Topology::boundary_loops
    std::optional<std::size_t> tip;    ///< node of the graph
    VertexId vertex = 0;               ///< of the surface there

    [[nodiscard]] bool is_visible() const { return patch || !rim.empty(); }
};

/// All ends: open borders, caps, then the tips that belong to none of them. A branch no longer than
/// its parent is wide whose tip is a corner of a border or cap is no end of its own.
[[nodiscard]] std::vector<SurfaceEnd> find_surface_ends(const Surface& surface,
                                                        const CenterlineGraph& graph);

/// True for a tip so near to an end that it is a part of it, as a corner of an oblique or ragged
/// one is. \param widest radius of the branch that ends there [mm]
[[nodiscard]] bool is_corner_of(const SurfaceEnd& end, const CenterlineGraph& graph,
                                const Vec3& tip, double widest);

/// The end nearest to a point; empty if there is none within 4 of its radii.
[[nodiscard]] std::optional<std::size_t> end_near(const std::vector<SurfaceEnd>& ends,
                                                  const Vec3& point);

/// The part of a branch beyond the wall of the vessel it leaves.
struct BlindBranch {
    double length = 0.0;     ///< [mm]
    double widest = 0.0;     ///< largest radius [mm]
    double parent = 0.0;     ///< radius of the widest other vessel at the furcation [mm]
    double narrowest = 0.0;  ///< radius of the narrowest other one [mm]
    bool bulges = false;     ///< wider than its neck, or than every vessel it joins: a sac
    bool necked = false;     ///< wider than its own neck by as much as sacs only are

    /// Not longer than a sac may be.
    [[nodiscard]] bool is_short() const;

    /// So short that removing it changes little: shorter than its parent is wide.
    [[nodiscard]] bool is_stub() const;
};

/// Empty for a vessel without a furcation.
[[nodiscard]] std::optional<BlindBranch> blind_branch(const CenterlineGraph& graph,
                                                      std::size_t tip);

/// How much wider a tip's branch becomes behind its neck, by the diameters of the wall's sections
/// [-]: the line may run beside a ball's middle, where the inscribed circles are small. 1: it does
/// not, or has no sections of its own.
/// \param tip of a branch with a furcation
[[nodiscard]] double section_rise(const Surface& surface, const CenterlineGraph& graph,
                                  std::size_t tip);

/// True for a vessel that others leave: none of the ends is clearly wider, it is clearly wider than
/// one of the vessels at its furcation, and it is no sac.
[[nodiscard]] bool is_trunk(const CenterlineGraph& graph, std::size_t tip);

}  // namespace vesselbench
