#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/colours.h"
#include "gpu/objects.h"
#include "gpu/render/view_camera.h"

namespace vesselbench {

struct Polyline {
    Positions points;  ///< [mm]
    Colour colour = Colour(0.02F, 0.02F, 0.02F);
    bool closed = false;  ///< the last point is joined to the first
};

/// Polylines in the current context's memory. Segments are numbered in order; picking names them.
class DrawnLines {
public:
    explicit DrawnLines(std::span<const Polyline> lines);

    [[nodiscard]] Sphere bounds() const { return bounds_; }

    [[nodiscard]] std::size_t segment_count() const { return count_; }

    void bind() const;

private:
    Sphere bounds_;
    std::size_t count_ = 0;
    Buffer segments_;
    VertexArray layout_;
};

/// A mark of a place, drawn as a disc with an outline.
struct PointMark {
    Vec3 place = Vec3::Zero();  ///< [mm]
    Colour colour = Colour(0.9F, 0.6F, 0.1F);
    double diameter = 9.0;  ///< [pixels]
};

class DrawnPoints {
public:
    explicit DrawnPoints(std::span<const PointMark> marks);

    [[nodiscard]] Sphere bounds() const { return bounds_; }

    [[nodiscard]] std::size_t count() const { return count_; }

    void bind() const;

private:
    Sphere bounds_;
    std::size_t count_ = 0;
    Buffer marks_;
    VertexArray layout_;
};

/// A rectangle in space with scalars: a slice of an image.
struct SliceScalars {
    Vec3 corner = Vec3::Zero();   ///< outer corner of the first pixel [mm]
    Vec3 across = Vec3(1, 0, 0);  ///< from there along a row, over its whole length [mm]
    Vec3 down = Vec3(0, 1, 0);    ///< along the columns [mm]
    int columns = 0, rows = 0;
    std::span<const float> values;  ///< rows x columns, a row after the other
};

/// A slice in the current context's memory.
class DrawnSlice {
public:
    /// \throw InvalidInput unless there are rows x columns values
    explicit DrawnSlice(const SliceScalars& scalars);

    [[nodiscard]] Sphere bounds() const;

    /// Shows other scalars; of the same size, no memory is allocated.
    void replace(const SliceScalars& scalars);

    /// Binds it, and its texture to unit 0.
    /// \param smooth interpolates between pixels
    void bind(bool smooth) const;

private:
    SliceScalars place_;
    Texture texture_;
    Buffer corners_;
    VertexArray layout_;
};

}  // namespace vesselbench
