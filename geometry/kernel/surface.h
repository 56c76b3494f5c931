#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// The role of a part of the surface for the solver. `Cut` is a flat closure that is
/// recognised as one, but not yet chosen as an opening (where a vessel left the
/// image).
enum class PatchKind : std::uint8_t { Wall, Inlet, Outlet, Cut };

[[nodiscard]] std::string to_string(PatchKind kind);

/// \throw InvalidInput if the name is not one of wall, inlet, outlet, cut
[[nodiscard]] PatchKind patch_kind_from(const std::string& name);

struct Patch {
    std::string name;  ///< "wall", "inlet", "outlet_1", "cut_1" ...
    PatchKind kind = PatchKind::Wall;

    bool operator==(const Patch&) const = default;
};

/// Per-triangle index into Surface::patches, #T.
using PatchLabels = std::vector<std::uint16_t>;

/// A vessel surface: connectivity, positions, patches and named per-vertex attributes. A value with
/// shared parts: copies are cheap, and shared parts never change. In files, a triangle's
/// `CellEntityIds` is its patch index + 1: 1 is the wall, 2... the openings, inlet first.
struct Surface {
    std::shared_ptr<const Topology> topology;
    std::shared_ptr<const Positions> positions;                ///< [mm], #V x 3
    std::shared_ptr<const PatchLabels> patch_labels;           ///< #T
    std::vector<Patch> patches = {{"wall", PatchKind::Wall}};  ///< patches[0] is always the wall
    std::map<std::string, std::shared_ptr<const std::vector<double>>> attributes;  ///< each #V

    [[nodiscard]] bool empty() const { return !topology || topology->triangle_count() == 0; }

    [[nodiscard]] std::size_t vertex_count() const {
        return topology ? topology->vertex_count() : 0;
    }

    [[nodiscard]] std::size_t triangle_count() const {
        return topology ? topology->triangle_count() : 0;
    }

    [[nodiscard]] std::span<const Triangle> triangles() const { return topology->triangles(); }

    [[nodiscard]] const Positions& points() const { return *positions; }

    [[nodiscard]] const Patch& patch_of(TriangleId t) const { return patches[(*patch_labels)[t]]; }

    /// The same surface with other positions (and therefore another shape).
    /// \throw InvalidInput unless #V long
    [[nodiscard]] Surface with_positions(Positions moved) const;

    /// The same surface with other patches.
    /// \throw InvalidInput unless labels is #T long and in range
    [[nodiscard]] Surface with_patches(PatchLabels labels, std::vector<Patch> table) const;
};

/// Makes a surface from plain arrays; without labels every triangle belongs to the wall.
/// \throw InvalidInput if an index is out of range
[[nodiscard]] Surface make_surface(Positions positions, std::vector<Triangle> triangles);
[[nodiscard]] Surface make_surface(Positions positions, std::vector<Triangle> triangles,
                                   PatchLabels labels, std::vector<Patch> patches);

/// Triangle normal scaled by twice the area [mm^2], outward for a correctly oriented surface.
[[nodiscard]] Vec3 area_normal(const Positions& positions, const Triangle& triangle);

}  // namespace vesselbench
