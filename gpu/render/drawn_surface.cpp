#include "gpu/render/drawn_surface.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "gpu/render/coarse_triangles.h"

namespace vesselbench {

namespace {

/// A surface of fewer triangles is drawn fast enough as it is.
constexpr std::size_t kFewTriangles = 60000;

/// A colour in 4 bytes, in the steps of pictures.
using ColourBytes = std::array<std::uint8_t, 4>;

ColourBytes colour_bytes(const Colour& colour) {
    const PixelColour pixel = pixel_colour(colour);
    return {pixel[0], pixel[1], pixel[2], 255};
}

void require_count(std::size_t given, std::size_t vertices, const char* what) {
    if (given != 0 && given != vertices)
        throw InvalidInput("there must be one " + std::string(what) + " per vertex: " +
                           std::to_string(given) + " were given for " + std::to_string(vertices));
}

/// Values of the surface's vertices for the drawn ones.
template <class To, class From, class Convert>
std::vector<To> for_drawn(const DrawingLayout& layout, std::span<const From> values,
                          const Convert& convert) {
    std::vector<To> drawn;
    drawn.reserve(layout.tags.size());
    for (const From& value : values) drawn.push_back(convert(value));
    for (const VertexId v : layout.extras) drawn.push_back(drawn[v]);
    return drawn;
}

float narrowed(double value) {
    return static_cast<float>(value);
}

}  // namespace

DrawnSurface::DrawnSurface(DrawingArrays arrays)
    : arrays_(std::move(arrays)),
      vertices_(make_buffer(bytes_of(arrays_.vertices), "drawn vertices")),
      triangles_(make_buffer(bytes_of(arrays_.layout->triangles), "drawn triangles")),
      layout_(make_vertex_array()) {
    describe();
}

/// Tells the vertex array where attributes are.
void DrawnSurface::describe() {
    constexpr std::size_t kStride = sizeof(DrawnVertex);
    glBindVertexArray(layout_.id());
    float_attribute(0, vertices_, 3, kStride, offsetof(DrawnVertex, position));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 3, GL_SHORT, GL_TRUE, kStride,
                          reinterpret_cast<const void*>(offsetof(DrawnVertex, normal)));
    glEnableVertexAttribArray(4);
    glVertexAttribIPointer(4, 1, GL_UNSIGNED_SHORT, kStride,
                           reinterpret_cast<const void*>(offsetof(DrawnVertex, tag)));
    if (values_)
        float_attribute(3, *values_, 1);
    else
        glDisableVertexAttribArray(3);
    if (colours_) {
        glBindBuffer(GL_ARRAY_BUFFER, colours_->id());
        glEnableVertexAttribArray(5);
        glVertexAttribPointer(5, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    } else {
        glDisableVertexAttribArray(5);
    }
    glBindVertexArray(0);
}

void DrawnSurface::move(const Positions& positions, std::span<const VertexId> moved) {
    const std::vector<std::uint32_t> changed = move_vertices(arrays_, positions, moved);
    upload_parts(vertices_, bytes_of(arrays_.vertices), sizeof(DrawnVertex), changed);
}

void DrawnSurface::move_all(DrawingArrays arrays) {
    arrays_ = std::move(arrays);
    upload_all(vertices_, bytes_of(arrays_.vertices));
}

void DrawnSurface::set_values(std::span<const double> values) {
    require_count(values.size(), arrays_.surface.vertex_count(), "value");
    value_list_.clear();
    values_.reset();
    if (!values.empty()) {
        value_list_ = for_drawn<float>(*arrays_.layout, values, narrowed);
        values_ = make_buffer(bytes_of(value_list_), "values");
    }
    describe();
}

void DrawnSurface::set_values(std::span<const double> values, std::span<const VertexId> changed) {
    if (!values_) return set_values(values);
    require_count(values.size(), arrays_.surface.vertex_count(), "value");
    const std::vector<std::uint32_t> drawn =
        drawn_copies(*arrays_.layout, arrays_.surface.vertex_count(), changed);
    for (const std::uint32_t i : drawn) value_list_[i] = narrowed(values[original_of(arrays_, i)]);
    upload_parts(*values_, bytes_of(value_list_), sizeof(float), drawn);
}

void DrawnSurface::set_colours(std::span<const Colour> colours) {
    require_count(colours.size(), arrays_.surface.vertex_count(), "colour");
    colours_.reset();
    if (!colours.empty()) {
        const auto drawn = for_drawn<ColourBytes>(*arrays_.layout, colours, colour_bytes);
        colours_ = make_buffer(bytes_of(drawn), "colours");
    }
    describe();
}

std::size_t DrawnSurface::bind_triangles(Detail detail) const {
    const bool coarse = detail == Detail::Coarse && triangle_count() > kFewTriangles;
    if (coarse && !coarse_) {
        const std::vector<Triangle> triangles = coarse_triangles(*arrays_.layout);
        coarse_ = {make_buffer(bytes_of(triangles), "coarse triangles"), triangles.size()};
    }
    glBindVertexArray(layout_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, coarse ? coarse_->buffer.id() : triangles_.id());
    return coarse ? coarse_->count : triangle_count();
}

std::size_t DrawnSurface::bind_edges() const {
    glBindVertexArray(layout_.id());
    return edges_.bind(*arrays_.surface.topology);
}

}  // namespace vesselbench
