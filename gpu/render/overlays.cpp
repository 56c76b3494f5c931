#include "gpu/render/overlays.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/render/bounding_sphere.h"
#include "gpu/render/vertex_buffers.h"

namespace vesselbench {

namespace {

using Floats = std::array<float, 3>;

/// An instance of gpu/shaders/polyline.vert.
struct Segment {
    Floats from, to, colour;
};

/// An instance of gpu/shaders/points.vert.
struct Mark {
    Floats place, colour;
    float diameter;
};

Floats floats(const Vec3& point) {
    return {static_cast<float>(point.x()), static_cast<float>(point.y()),
            static_cast<float>(point.z())};
}

Floats floats(const Colour& colour) {
    return {colour.x(), colour.y(), colour.z()};
}

Sphere sphere_of(std::span<const Polyline> lines) {
    Positions all;
    for (const Polyline& line : lines)
        all.insert(all.end(), line.points.begin(), line.points.end());
    return sphere_around(all);
}

Sphere sphere_of(std::span<const PointMark> marks) {
    Positions all;
    for (const PointMark& mark : marks) all.push_back(mark.place);
    return sphere_around(all);
}

std::vector<Segment> segments_of(std::span<const Polyline> lines, const Vec3& centre) {
    std::vector<Segment> segments;
    for (const Polyline& line : lines) {
        const std::size_t count = line.points.size();
        const std::size_t last = count < 2 ? 0 : line.closed ? count : count - 1;
        for (std::size_t i = 0; i < last; ++i)
            segments.push_back({floats(Vec3(line.points[i] - centre)),
                                floats(Vec3(line.points[(i + 1) % count] - centre)),
                                floats(line.colour)});
    }
    return segments;
}

std::vector<Mark> marks_of(std::span<const PointMark> marks, const Vec3& centre) {
    std::vector<Mark> list;
    for (const PointMark& mark : marks)
        list.push_back({floats(Vec3(mark.place - centre)), floats(mark.colour),
                        static_cast<float>(mark.diameter)});
    return list;
}

/// Attribute of an array of instances.
template <class Instance>
void instance_attribute(unsigned place, const Buffer& buffer, int numbers, std::size_t offset) {
    float_attribute(place, buffer, numbers, sizeof(Instance), offset);
    glVertexAttribDivisor(place, 1);
}

}  // namespace

DrawnLines::DrawnLines(std::span<const Polyline> lines)
    : bounds_(sphere_of(lines)), layout_(make_vertex_array()) {
    const std::vector<Segment> segments = segments_of(lines, bounds_.centre);
    count_ = segments.size();
    segments_ = make_buffer(bytes_of(segments), "line segments");
    glBindVertexArray(layout_.id());
    instance_attribute<Segment>(0, segments_, 3, offsetof(Segment, from));
    instance_attribute<Segment>(1, segments_, 3, offsetof(Segment, to));
    instance_attribute<Segment>(2, segments_, 3, offsetof(Segment, colour));
    glBindVertexArray(0);
}

void DrawnLines::bind() const {
    glBindVertexArray(layout_.id());
}

DrawnPoints::DrawnPoints(std::span<const PointMark> marks)
    : bounds_(sphere_of(marks)), count_(marks.size()), layout_(make_vertex_array()) {
    marks_ = make_buffer(bytes_of(marks_of(marks, bounds_.centre)), "marks");
    glBindVertexArray(layout_.id());
    instance_attribute<Mark>(0, marks_, 3, offsetof(Mark, place));
    instance_attribute<Mark>(1, marks_, 3, offsetof(Mark, colour));
    instance_attribute<Mark>(2, marks_, 1, offsetof(Mark, diameter));
    glBindVertexArray(0);
}

void DrawnPoints::bind() const {
    glBindVertexArray(layout_.id());
}

DrawnSlice::DrawnSlice(const SliceScalars& scalars) : layout_(make_vertex_array()) {
    unsigned id = 0;
    glGenTextures(1, &id);
    texture_ = Texture(id);
    replace(scalars);
}

Sphere DrawnSlice::bounds() const {
    return {
        place_.corner + 0.5 * (place_.across + place_.down),
        0.5 * std::max((place_.across + place_.down).norm(), (place_.across - place_.down).norm())};
}

void DrawnSlice::replace(const SliceScalars& scalars) {
    if (scalars.columns < 1 || scalars.rows < 1 ||
        scalars.values.size() !=
            static_cast<std::size_t>(scalars.columns) * static_cast<std::size_t>(scalars.rows))
        throw InvalidInput("a slice needs rows x columns values");
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (scalars.columns == place_.columns && scalars.rows == place_.rows)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, scalars.columns, scalars.rows, GL_RED, GL_FLOAT,
                        scalars.values.data());
    else
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, scalars.columns, scalars.rows, 0, GL_RED, GL_FLOAT,
                     scalars.values.data());
    for (const unsigned name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    place_ = scalars;
    place_.values = {};
    const Vec3 corner = -0.5 * (place_.across + place_.down);
    const std::vector<Floats> corners = {floats(corner), floats(Vec3(corner + place_.across)),
                                         floats(Vec3(corner + place_.down)),
                                         floats(Vec3(corner + place_.across + place_.down))};
    corners_ = make_buffer(bytes_of(corners), "slice corners");
    glBindVertexArray(layout_.id());
    float_attribute(0, corners_, 3);
    glBindVertexArray(0);
}

void DrawnSlice::bind(bool smooth) const {
    glBindVertexArray(layout_.id());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    const int filter = smooth ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
}

}  // namespace vesselbench
