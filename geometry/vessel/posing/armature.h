#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/tree/tube.h"

namespace vesselbench {

/// A stretch of a rod that turns by one angle, evenly distributed over it.
struct RodElement {
    std::size_t first = 0, last = 0;  ///< points of the rod
    double length = 0.0;              ///< [mm]
    double radius = 0.0;              ///< of the vessel [mm]
    double flexibility = 1.0;         ///< (0, 1]: less where bending fades out [-]
};

/// A branch as an inextensible elastic rod, whose smooth axis at rest leads from its end at the
/// root of the tree to its far end.
struct Rod : Tube {
    std::size_t branch = 0;  ///< of the centerline graph
    std::size_t root_node = 0, far_node = 0;
    std::optional<std::size_t> parent;  ///< the rod whose far end carries this one's root
    std::size_t begin = 0, end = 0;     ///< points of the axis between which it may bend
    bool free_end = false;              ///< nothing but a vessel's end hangs on it
    std::vector<RodElement> elements;
};

/// What carries a point of the surface.
struct Binding {
    static constexpr std::uint32_t kFixed = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t rod = kFixed;
    std::uint32_t segment = 0;  ///< of the rod's axis
    double t = 0.0;             ///< on the segment, in [0, 1]
    bool rigid = true;          ///< it belongs to a furcation, a cap or a branch without a rod
};

/// A branch that cannot be bent.
struct StiffBranch {
    std::size_t branch = 0;
    std::string code;           ///< "branch-too-short-to-bend", "branch-in-loop"
    Vec3 place = Vec3::Zero();  ///< [mm]
    double length = 0.0;        ///< [mm]
};

/// Rods inside a surface and which of them carries each vertex. Furcations, caps and stiff branches
/// are rigid bodies between the rods.
struct Armature {
    std::vector<Rod> rods;          ///< a parent before those it carries
    std::vector<Binding> bindings;  ///< #V
    std::vector<StiffBranch> stiff;
};

/// The node that stays: the tip at the inlet, else the widest tip of its tree; in a tree without
/// tips its first node.
/// \param branch of the tree
[[nodiscard]] std::size_t root_of(const Surface& surface, const CenterlineGraph& graph,
                                  std::size_t branch);

/// Rods of the branches, and the surface bound to them. Sleeve and rigid bodies are separated
/// by closed sections around each branch, and found along the surface from there, so that walls
/// that are near each other in space are not mixed up.
/// \param branches of the graph
/// \throw Cancelled
[[nodiscard]] Armature make_armature(const Surface& surface, const CenterlineGraph& graph,
                                     const std::vector<std::size_t>& branches,
                                     const Progress& progress = {});

/// Divides the stretch of a rod that is within [from, to] and may bend into elements.
/// \param from, to arc lengths [mm]
/// \param fade length over which the flexibility grows from nothing at both ends of the stretch,
///        except at a free end [mm]
/// \param spacing of the elements [mm]
void divide(Rod& rod, double from, double to, double fade, double spacing);

}  // namespace vesselbench
