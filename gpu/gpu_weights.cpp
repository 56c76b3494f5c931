#include "gpu/gpu_weights.h"

#include <array>
#include <bit>
#include <string>
#include <utility>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "smoothing/context/staircase_weights.h"

namespace vesselbench {

namespace {

constexpr double kFar = 3e38;  // gpu/shaders/distance_weight.comp

enum Kind { Staircases, Linear, Exponential, NoDistance };

}  // namespace

GpuWeights::GpuWeights(std::shared_ptr<const DeviceSurface> surface)
    : surface_(std::move(surface)) {
    const Device& device = surface_->device();
    const std::size_t count = surface_->vertex_count();
    changes_ = make_storage(device, count * sizeof(double), "orientation changes");
    fill_storage(device, changes_, 0);
    ones_ = make_storage(device, count * sizeof(float), "ones");
    fill_storage(device, ones_, std::bit_cast<std::uint32_t>(1.0F));
    weights_ = make_storage(device, count * sizeof(float), "weights");
    restart();
}

void GpuWeights::restart() {
    copy_storage(surface_->device(), ones_, weights_, surface_->vertex_count() * sizeof(float));
}

void GpuWeights::find_orientation_change(const StackAxes& stack_axes) {
    std::vector<Vec3> axes;  // checked before anything changes
    for (const Vec3& axis : stack_axes) axes.push_back(unit_axis(axis));
    const Device& device = surface_->device();
    const std::size_t triangles = surface_->surface().triangle_count();
    const Buffer orientations = make_storage(device, triangles * sizeof(double), "orientations");
    const Program &of_faces = surface_->program("face_orientation"),
                  &of_vertices = surface_->program("orientation_change");
    const DeviceRows& rows = surface_->triangles_at();
    fill_storage(device, changes_, 0);
    for (const Vec3& axis : axes) {
        bind_storage({&surface_->exact(), &surface_->triangles(), &orientations});
        glUseProgram(of_faces.id());
        glUniform3d(1, axis.x(), axis.y(), axis.z());
        dispatch(device, of_faces, triangles);
        bind_storage({&orientations, &changes_, nullptr, &rows.offsets, &rows.values});
        dispatch(device, of_vertices, surface_->vertex_count());
    }
    search_.reset();
}

std::vector<double> GpuWeights::orientation_change() const {
    return read_vertices<double>(*surface_, changes_);
}

void GpuWeights::find_staircase_distances(const StaircaseParameters& parameters) {
    std::vector<float> free(surface_->vertex_count(), 1.0F);
    for (std::size_t v = 0; v < parameters.caps.size(); ++v)
        if (parameters.caps[v] != 0) free[v] = 0.0F;
    Buffer free_of_caps = make_vertices(*surface_, std::move(free), "free of caps");
    staircases_ = search_staircases(*surface_, changes_, free_of_caps, parameters.tau_theta,
                                    parameters.tau_max);
    free_of_caps_ = std::move(free_of_caps);  // after a failed search, nothing has changed
}

void GpuWeights::multiply(const Buffer& distances, const Buffer& factors,
                          std::span<const float> scale, int kind) {
    const Program& program = surface_->program("distance_weight");
    bind_storage({&distances, &weights_, &factors});
    glUseProgram(program.id());
    glUniform4fv(1, 1, scale.data());
    glUniform1i(2, kind);
    dispatch(surface_->device(), program, surface_->vertex_count());
}

void GpuWeights::multiply_staircases(const StaircaseParameters& parameters) {
    const Search wanted{
        parameters.tau_theta, parameters.tau_max, {parameters.caps.begin(), parameters.caps.end()}};
    require_staircase_parameters(surface_->vertex_count(), parameters);
    if (search_ != wanted) {
        find_staircase_distances(parameters);
        search_ = wanted;
    }
    const double largest =
        parameters.scaling == StaircaseScaling::Thesis ? staircases_.farthest : parameters.tau_max;
    const std::array scale = {static_cast<float>(largest), static_cast<float>(parameters.beta_min),
                              0.0F, 0.0F};
    multiply(staircases_.distances, free_of_caps_, scale, Staircases);
}

void GpuWeights::multiply_distances(const NeighbourDistances& distances,
                                    const DistanceParameters& parameters) {
    require_distance_parameters(parameters);
    if (distances.count != surface_->vertex_count())
        throw InvalidInput("got " + std::to_string(distances.count) + " distances for " +
                           std::to_string(surface_->vertex_count()) + " vertices");
    if (!(distances.most < kFar))
        throw InvalidInput("distances to neighbours must be finite and not negative");
    const double from =
        parameters.scaling == DistanceScaling::Margin ? parameters.margin : distances.least;
    const std::array scale = {static_cast<float>(from), static_cast<float>(distances.most - from),
                              static_cast<float>(parameters.omega), 0.0F};
    multiply(distances.distances, ones_, scale,
             parameters.scaling == DistanceScaling::Exponential ? Exponential : Linear);
}

void GpuWeights::multiply(const Buffer& others) {
    multiply(ones_, others, std::array<float, 4>{}, NoDistance);
}

}  // namespace vesselbench
