#include "gpu/render/drawn_device_surface.h"

#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/solid_surface.h"
#include "gpu/render/bounding_sphere.h"
#include "gpu/render/drawing_arrays.h"
#include "gpu/render/vertex_buffers.h"

namespace vesselbench {

namespace {

constexpr double kRoom = 1.2;  // smoothing may move vertices beyond the start's bounds

Sphere roomy_bounds(const DeviceSurface& surface) {
    Sphere sphere = sphere_around(surface.surface().points(), surface.centre());
    sphere.radius *= kRoom;
    return sphere;
}

}  // namespace

DrawnDeviceSurface::DrawnDeviceSurface(std::shared_ptr<const DeviceSurface> surface)
    : surface_(std::move(surface)), bounds_(roomy_bounds(*surface_)), layout_(make_vertex_array()) {
    solid_ = is_solid_surface(surface_->surface());
    static_cast<void>(surface_->triangles());
}

void DrawnDeviceSurface::bind_vertices() const {
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT);
    constexpr std::size_t kStride = 4 * sizeof(float);
    glBindVertexArray(layout_.id());
    float_attribute(0, surface_->anchors(), 3, kStride);
    float_attribute(1, *shown_.shifts, 3, kStride);
    float_attribute(2, *shown_.normals, 3, kStride);
    if (shown_.values != nullptr)
        float_attribute(3, *shown_.values, 1);
    else
        glDisableVertexAttribArray(3);
}

std::size_t DrawnDeviceSurface::bind_triangles(Detail) const {
    bind_vertices();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, surface_->triangles().buffer.id());
    return triangle_count();
}

std::size_t DrawnDeviceSurface::bind_edges() const {
    bind_vertices();
    return edges_.bind(*surface_->surface().topology, surface_->order());
}

}  // namespace vesselbench
