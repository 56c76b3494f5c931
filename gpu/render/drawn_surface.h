#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/colours.h"
#include "gpu/objects.h"
#include "gpu/render/drawing_arrays.h"
#include "gpu/render/surface_source.h"
#include "gpu/render/vertex_buffers.h"

namespace vesselbench {

/// A surface uploaded for drawing: about 16 bytes a triangle for indices and 10 for vertices. The
/// context of construction must be current whenever it is used or destroyed.
class DrawnSurface final : public SurfaceSource {
public:
    /// \throw GpuUnavailable if the device is out of memory
    explicit DrawnSurface(DrawingArrays arrays);

    /// The surface it shows; positions of moved vertices are in its arrays only.
    [[nodiscard]] const Surface& surface() const { return arrays_.surface; }

    [[nodiscard]] const DrawingArrays& arrays() const { return arrays_; }

    /// Moves some vertices, as a dab of a brush does, and uploads the touched bytes.
    /// \param positions #V [mm]
    void move(const Positions& positions, std::span<const VertexId> moved);

    /// Takes other positions for all vertices; triangles stay on the device.
    /// \param arrays prepared with the layout of arrays()
    void move_all(DrawingArrays arrays);

    /// Values for colour maps, #V; not-a-number: no value. Empty: removes them.
    /// \throw InvalidInput unless #V long or empty
    void set_values(std::span<const double> values);

    /// Some of the values again, as painting weights does.
    /// \param values #V
    void set_values(std::span<const double> values, std::span<const VertexId> changed);

    /// Colours of the vertices, #V. Empty: removes them.
    /// \throw InvalidInput unless #V long or empty
    void set_colours(std::span<const Colour> colours);

    [[nodiscard]] Sphere bounds() const override { return arrays_.bounds; }

    [[nodiscard]] std::size_t triangle_count() const override {
        return arrays_.layout->triangles.size();
    }

    [[nodiscard]] bool has_values() const override { return values_.has_value(); }

    [[nodiscard]] bool has_colours() const override { return colours_.has_value(); }

    [[nodiscard]] bool is_solid() const override { return arrays_.layout->solid; }

    [[nodiscard]] bool has_corners() const override { return true; }

    /// \throw GpuUnavailable if the device has no memory for the coarse ones, made on first use
    std::size_t bind_triangles(Detail detail) const override;
    std::size_t bind_edges() const override;

private:
    void describe();

    DrawingArrays arrays_;
    Buffer vertices_, triangles_;

    /// Made on first use.
    struct CoarseTriangles {
        Buffer buffer;
        std::size_t count = 0;
    };

    mutable std::optional<CoarseTriangles> coarse_;
    std::vector<float> value_list_;  ///< of the drawn vertices
    std::optional<Buffer> values_, colours_;
    mutable DrawnEdges edges_;
    VertexArray layout_;
};

}  // namespace vesselbench
