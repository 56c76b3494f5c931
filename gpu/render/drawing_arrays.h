#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/render/view_camera.h"

namespace vesselbench {

/// A vertex as the device draws it.
struct DrawnVertex {
    std::array<float, 3> position{};       ///< [mm], relative to the drawing's centre
    std::array<std::int16_t, 3> normal{};  ///< unit normal times 32767
    std::uint16_t tag = 0;                 ///< 4 * patch label + colour of the corner (0 to 3)
};

/// How a surface's vertices are split for drawing. Vertices are split where patches meet, so that
/// rims of caps stay sharp, and in a few places so that the three corners of every triangle have
/// different ones of four corner colours: interpolated, the third largest of the four is the
/// smallest barycentric coordinate, which gives the distance to the nearest edge in the pass that
/// fills triangles.
struct DrawingLayout {
    std::vector<Triangle> triangles;  ///< corners as drawn vertices, in the surface's order, #T
    std::vector<std::uint16_t> tags;  ///< of the drawn vertices
    /// Drawn vertex v < #V is the surface's vertex v; drawn vertex #V + i is another copy of vertex
    /// extras[i]. Ascending.
    std::vector<VertexId> extras;
    bool solid = false;                        ///< is_solid_surface of the surface it was made for
    std::shared_ptr<const Topology> topology;  ///< of that surface
    std::shared_ptr<const PatchLabels> patch_labels;  ///< of that surface

    /// The surface's vertex that a drawn vertex is a copy of.
    [[nodiscard]] VertexId original_of(std::size_t drawn) const {
        const std::size_t count = tags.size() - extras.size();
        return drawn < count ? static_cast<VertexId>(drawn) : extras[drawn - count];
    }

    /// Drawn vertices #V + first ... #V + last - 1 are the further copies of a vertex.
    [[nodiscard]] std::array<std::size_t, 2> extras_of(VertexId v) const;
};

/// What is uploaded to draw a surface: a value that any thread can make.
struct DrawingArrays {
    Surface surface;  ///< what was prepared; shares its parts
    std::shared_ptr<const DrawingLayout> layout;
    std::vector<DrawnVertex> vertices;  ///< #V + #extras
    Sphere bounds;                      ///< its centre is the origin of positions
};

/// Smooth normals are those of a vertex's triangles of the same patch, weighted by area.
/// \param known layout, which is shared if it was made for the same topology and patches: only
///        positions and normals are computed then
/// \throw InvalidInput if the surface is empty
[[nodiscard]] DrawingArrays prepare_drawing(const Surface& surface,
                                            std::shared_ptr<const DrawingLayout> known = nullptr);

/// Moves some vertices: recomputes their copies and the normals of their triangles' corners. Centre
/// and layout stay.
/// \param positions #V; those of `moved` are read, and of their neighbours
/// \return the drawn vertices that changed, ascending
std::vector<std::uint32_t> move_vertices(DrawingArrays& drawing, const Positions& positions,
                                         std::span<const VertexId> moved);

/// The surface's vertex that a drawn vertex is a copy of.
[[nodiscard]] VertexId original_of(const DrawingArrays& drawing, std::size_t drawn);

/// All copies of some vertices, ascending.
/// \param vertex_count #V
[[nodiscard]] std::vector<std::uint32_t> drawn_copies(const DrawingLayout& layout,
                                                      std::size_t vertex_count,
                                                      std::span<const VertexId> vertices);

/// Every edge once, as drawn vertices, for GL_LINES: edge_table's edges without their triangles,
/// fast enough for a frame.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> unique_edges(const Topology& topology);

}  // namespace vesselbench
