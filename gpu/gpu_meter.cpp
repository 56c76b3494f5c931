#include "gpu/gpu_meter.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/local_error.h"

namespace vesselbench {

namespace {

using Eigen::Vector4f;

CompressedRows rim_rows(const Topology& topology) {
    CompressedRows rows{{0}, {}};
    const auto& boundary = topology.boundary_vertices();
    if (std::ranges::find(boundary, 1) == boundary.end()) return rows;
    for (const auto& loop : topology.boundary_loops()) {
        rows.values.insert(rows.values.end(), loop.begin(), loop.end());
        rows.offsets.push_back(static_cast<std::uint32_t>(rows.values.size()));
    }
    return rows;
}

}  // namespace

GpuMeter::GpuMeter(std::shared_ptr<const DeviceSurface> surface, std::size_t states, bool planes)
    : surface_(std::move(surface)), planes_(planes) {
    const Device& device = surface_->device();
    const std::size_t count = surface_->vertex_count();
    const Topology& topology = *surface_->surface().topology;
    const DeviceOrder& order = surface_->order();
    CompressedRows rims = rim_rows(topology);
    rims.values = order.as_places(std::move(rims.values));
    rim_count_ = rims.offsets.size() - 1;
    rims_ = {make_storage(device, std::span<const std::uint32_t>(rims.offsets), "rim offsets"),
             {make_storage(device, std::span<const std::uint32_t>(rims.values), "rims")}};
    own_references_ =
        make_vertices(*surface_, order.as_places(own_references(topology)), "own references");
    references_ = make_storage(device, count * sizeof(VertexId), "references");
    normals_ = make_storage(device, count * sizeof(Vector4f), "normals");
    errors_ = make_storage(device, count * sizeof(float), "local errors");
    const std::size_t groups = group_count(count);
    shape_parts_ = make_storage(device, (groups + rim_count_) * sizeof(Vector4f), "parts of shape");
    error_parts_ = make_storage(device, groups * sizeof(Vector4f), "parts of errors");
    results_ = make_storage(device, 2 * states * sizeof(Vector4f), "measures");
    restart();
}

void GpuMeter::restart() {
    copy_storage(surface_->device(), own_references_, references_,
                 surface_->vertex_count() * sizeof(VertexId));
}

void GpuMeter::measure_shape(const Buffer& shifts) {
    find_shape(shifts, Then::Wait);
}

void GpuMeter::find_shape(const Buffer& shifts, Then then) {
    const DeviceRows& corners = surface_->corners();
    bind_storage({&shifts, &normals_, &shape_parts_, &corners.offsets, &corners.values, nullptr,
                  &surface_->anchors()});
    dispatch(surface_->device(), surface_->program("shape"), surface_->vertex_count(), then);
}

void GpuMeter::add_rims(const Buffer& shifts) {
    if (rim_count_ == 0) return;
    bind_storage({&shifts, nullptr, &shape_parts_, &rims_.offsets, &rims_.values, nullptr,
                  &surface_->anchors()});
    const Program& program = surface_->program("rim_volume");
    glUseProgram(program.id());
    glUniform1ui(1, static_cast<unsigned>(group_count(surface_->vertex_count())));
    dispatch(surface_->device(), program, rim_count_ * kGroupSize, Then::GoOn);
}

void GpuMeter::find_error(const Buffer& shifts, const Buffer& references, bool follow) {
    const DeviceRows& corners = surface_->corners();
    bind_storage({&shifts, &errors_, &error_parts_, &corners.offsets, &corners.values,
                  &surface_->shifts(), &surface_->anchors(), &references});
    const Program& program = surface_->program("local_error");
    glUseProgram(program.id());
    glUniform1i(1, planes_ ? 1 : 0);
    glUniform1i(2, follow ? 1 : 0);
    dispatch(surface_->device(), program, surface_->vertex_count());
}

void GpuMeter::total(const Buffer& parts, std::size_t count, std::size_t place, Then then) {
    bind_storage({&parts, &results_});
    const Program& program = surface_->program("total");
    glUseProgram(program.id());
    glUniform1ui(1, static_cast<unsigned>(place));
    dispatch_group(surface_->device(), program, count, then);
}

PooledBuffer GpuMeter::copy_of(const Buffer& references) const {
    const std::size_t bytes = surface_->vertex_count() * sizeof(VertexId);
    PooledBuffer copy(surface_->device(), bytes, "references");
    copy_storage(surface_->device(), references, copy, bytes);
    return copy;
}

void GpuMeter::follow(const Buffer& shifts, const Buffer& references) {
    const DeviceRows& corners = surface_->corners();
    bind_storage({&shifts, nullptr, nullptr, &corners.offsets, &corners.values, &surface_->shifts(),
                  &surface_->anchors(), &references});
    dispatch(surface_->device(), surface_->program("follow_drift"), surface_->vertex_count());
}

void GpuMeter::measure(const Buffer& shifts, std::size_t state) {
    measure(shifts, references_, true, state);
}

void GpuMeter::measure(const Buffer& shifts, const Buffer& references, bool follow,
                       std::size_t state) {
    const std::size_t groups = group_count(surface_->vertex_count());
    // Shape, rims and error write different buffers, and none reads another one's.
    find_shape(shifts, Then::GoOn);
    add_rims(shifts);
    find_error(shifts, references, follow);
    total(shape_parts_, groups + rim_count_, 2 * state, Then::GoOn);
    total(error_parts_, groups, 2 * state + 1, Then::Wait);
}

std::vector<DeviceMeasures> GpuMeter::read(std::size_t states) const {
    const auto totals = read_storage<Vector4f>(surface_->device(), results_, 2 * states);
    const auto count = static_cast<double>(surface_->vertex_count());
    std::vector<DeviceMeasures> measures(states);
    for (std::size_t i = 0; i < states; ++i) {
        const Vector4f &shape = totals[2 * i], &error = totals[2 * i + 1];
        measures[i].quality = {.error = error.x() / count,
                               .error_thesis = error.y() / count,
                               .curvature = shape.x(),
                               .curvature_abs = shape.y(),
                               .volume = shape.z()};
        measures[i].largest_error = error.w();
    }
    return measures;
}

}  // namespace vesselbench
