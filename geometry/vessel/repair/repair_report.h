#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/piece_shape.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

enum class RepairKind {
    Weld,
    Degenerate,
    Duplicate,
    Component,
    NonManifold,
    Orientation,
    SelfIntersection,
    Hole,
    ShortEdge
};

[[nodiscard]] std::string to_string(RepairKind kind);

/// A repaired place.
struct RepairPlace {
    RepairKind kind = RepairKind::Weld;
    Vec3 position = Vec3::Zero();  ///< [mm]
    double size = 0.0;             ///< radius of the place [mm]; 0: a point
};

/// A closed hole that may have been a vessel's end.
struct ClosedHole {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 0.0;         ///< of the circle of the same area [mm]
    double lumen_radius = 0.0;   ///< of the vessel behind it [mm]
    bool in_wall = false;        ///< a branch torn off at the wall; else as wide as the vessel
};

/// An open end that was left open.
struct KeptOpening {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 0.0;         ///< of the circle of the same area [mm]
    std::size_t edges = 0;
};

/// The actions of repair; all zero for a clean surface.
struct RepairReport {
    std::size_t welded_vertices = 0;
    std::size_t unused_vertices = 0;
    std::size_t degenerate_triangles = 0;
    std::size_t duplicate_triangles = 0;
    std::size_t removed_components = 0;
    std::size_t removed_component_triangles = 0;
    std::optional<PieceShape> removed_vessel;  ///< the longest one that is a vessel
    std::size_t keeping_it = 0;                ///< number of components to keep so that it stays
    bool removed_outer_wall = false;           ///< of a wall with two sides
    bool removed_inner_wall = false;           ///< the same, where the outer one is wanted
    std::size_t non_manifold_edges = 0;
    std::size_t non_manifold_vertices = 0;
    std::size_t turned_triangles = 0;    ///< to make the orientation consistent
    bool turned_inside_out = false;      ///< the whole surface was reversed
    std::size_t self_intersections = 0;  ///< pairs found at the start
    std::size_t refilled_triangles = 0;  ///< cut out around them
    std::size_t smoothed_vertices = 0;   ///< moved to separate them
    std::size_t closed_holes = 0;
    std::vector<ClosedHole> closed_ends;
    std::size_t collapsed_edges = 0;
    std::size_t flipped_edges = 0;
    std::vector<KeptOpening> openings;
    std::vector<RepairPlace> places;
    /// Radius that separates the closed holes from the kept openings [mm], if there is one.
    std::optional<double> closed_up_to;

    [[nodiscard]] bool changed() const;
};

}  // namespace vesselbench
