#pragma once

#include "gpu/render/view_camera.h"

namespace vesselbench {

/// How much of a surface is drawn.
enum class Detail {
    Full,
    Coarse  ///< fewer triangles, if the surface is large (coarse_triangles.h)
};

/// A surface in buffers of the current context that a SurfaceLayer shows. Implementations:
/// DrawnSurface (from the CPU) and DrawnDeviceSurface (from the buffers that smoothing works on).
class SurfaceSource {
public:
    virtual ~SurfaceSource() = default;

    /// Origin of its positions and a radius around it that contains all of them [mm].
    [[nodiscard]] virtual Sphere bounds() const = 0;
    [[nodiscard]] virtual std::size_t triangle_count() const = 0;
    [[nodiscard]] virtual bool has_values() const = 0;
    [[nodiscard]] virtual bool has_colours() const = 0;

    /// Whether it is closed and turned outward, so that its inner side is only seen from inside.
    [[nodiscard]] virtual bool is_solid() const = 0;

    /// Whether corners have colours (drawing_arrays.h), so that edges are drawn in the pass that
    /// fills triangles.
    [[nodiscard]] virtual bool has_corners() const = 0;

    /// Binds the vertex array whose elements are the triangles. Attributes:
    /// gpu/shaders/surface.vert.
    /// \return number of triangles
    virtual std::size_t bind_triangles(Detail detail) const = 0;

    /// Binds the vertex array with unique edges as elements, made on first use.
    /// \return number of edges
    virtual std::size_t bind_edges() const = 0;

protected:
    SurfaceSource() = default;
    SurfaceSource(const SurfaceSource&) = default;
    SurfaceSource& operator=(const SurfaceSource&) = default;
    SurfaceSource(SurfaceSource&&) = default;
    SurfaceSource& operator=(SurfaceSource&&) = default;
};

}  // namespace vesselbench
