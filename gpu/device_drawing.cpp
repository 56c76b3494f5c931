#include "gpu/device_drawing.h"

#include <utility>
#include <vector>

#include <epoxy/gl.h>

namespace vesselbench {

namespace {

using Eigen::Vector4f;

constexpr int kScaleSteps = 256;  // gpu/shaders/device_surface.vert

Buffer heated_scale(const Device& device) {
    std::vector<Vector4f> scale(kScaleSteps);
    for (int i = 0; i < kScaleSteps; ++i)
        scale[static_cast<std::size_t>(i)]
            << heated_colour(static_cast<double>(i) / (kScaleSteps - 1)),
            1.0F;
    return make_storage(device, std::span<const Vector4f>(scale), "colour scale");
}

VertexArray make_vertex_array() {
    unsigned id = 0;
    glGenVertexArrays(1, &id);
    return VertexArray(id);
}

void attribute(unsigned place, const Buffer& buffer, int numbers) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, numbers, GL_FLOAT, GL_FALSE, 0, nullptr);
}

}  // namespace

DeviceDrawing::DeviceDrawing(std::shared_ptr<const DeviceSurface> surface)
    : surface_(std::move(surface)),
      program_(make_program("device_surface", "surface")),
      vertices_(make_vertex_array()),
      scale_(heated_scale(surface_->device())) {}

void DeviceDrawing::draw(const DeviceState& state, const Camera& camera) const {
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT);
    glBindVertexArray(vertices_.id());
    attribute(0, surface_->anchors(), 4);
    attribute(1, state.shifts, 4);
    attribute(2, state.normals, 4);
    if (state.values != nullptr)
        attribute(3, *state.values, 1);
    else
        glDisableVertexAttribArray(3);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, surface_->triangles().id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, scale_.id());
    set_matrices(program_, camera);
    const Eigen::Vector3f back = PictureOptions{}.back.cast<float>();
    glUniform3fv(glGetUniformLocation(program_.id(), "back_colour"), 1, back.data());
    glUniform1i(glGetUniformLocation(program_.id(), "by_value"), state.values != nullptr ? 1 : 0);
    glUniform2f(glGetUniformLocation(program_.id(), "range"), static_cast<float>(state.least),
                static_cast<float>(state.most));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * surface_->surface().triangle_count()),
                   GL_UNSIGNED_INT, nullptr);
}

Picture picture_of(const DeviceSurface& surface, const DeviceDrawing& drawing,
                   const DeviceState& state, const PictureOptions& options) {
    require_size(options);
    const Camera camera = camera_for(surface.surface().points(), surface.centre(), options);
    const Canvas canvas(options.width, options.height);
    drawing.draw(state, camera);
    Picture picture = canvas.picture();
    require_context(surface.device());
    return picture;
}

}  // namespace vesselbench
