#include "gpu/gpu_smoother.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/divergence.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/linear_steps.h"

namespace vesselbench {

namespace {

using Eigen::Vector4f;

constexpr float kFixed = -1.0F;

/// Uniforms of gpu/shaders/filter_pass.glsl.
enum Uniform {
    Factors = 1,
    Onto,
    Last,
    OfPositions,
    Iteration,
    Cell,
    HalfSize,
    CellAxes,
    FeatureCurvature
};

/// Shifts at the start, with w the vertex's weight, or kFixed.
std::vector<Vector4f> weighted_start(const DeviceSurface& surface, const FilterSettings& settings) {
    const Positions& points = surface.surface().points();
    const auto fixed = checked_fixed_vertices(*surface.surface().topology, points, settings);
    std::vector<Vector4f> start(points.size());
    for_each_vertex(start.size(), [&](std::size_t place) {
        const VertexId v = surface.order().vertex_at(place);
        const double weight = settings.weights.empty() ? 1.0 : settings.weights[v];
        start[place] << device_point(points[v], surface.centre()).shift,
            fixed[v] != 0 ? kFixed : static_cast<float>(weight);
    });
    return start;
}

}  // namespace

GpuSmoother::GpuSmoother(std::shared_ptr<const DeviceSurface> surface,
                         const FilterSettings& settings)
    : surface_(std::move(surface)), rings_(settings.rings), constraint_(settings.constraint) {
    const std::vector<Vector4f> start = weighted_start(*surface_, settings);
    const std::size_t bytes = start.size() * sizeof(Vector4f);
    start_ = std::make_shared<const PooledBuffer>(
        surface_->device(), bytes,
        make_storage(surface_->device(), std::span<const Vector4f>(start), "start"));
    for (PooledBuffer& values : values_) values = PooledBuffer(surface_->device(), bytes, "shifts");
    copy_storage(surface_->device(), *start_, values_[0], bytes);
}

GpuSmoother GpuSmoother::another() const {
    GpuSmoother other;
    other.surface_ = surface_;
    other.rings_ = rings_;
    other.constraint_ = constraint_;
    other.start_ = start_;
    const std::size_t bytes = surface_->vertex_count() * sizeof(Vector4f);
    for (PooledBuffer& values : other.values_)
        values = PooledBuffer(surface_->device(), bytes, "shifts");
    return other;
}

GpuSmoother GpuSmoother::copy() const {
    const Device& device = surface_->device();
    GpuSmoother other = another();
    other.passes_ = passes_;
    other.steps_done_ = steps_done_;
    other.iterations_done_ = iterations_done_;
    const std::size_t count = surface_->vertex_count();
    const std::size_t source = steps_done_ % 2;  // a run's first pass writes all of the other one
    copy_storage(device, values_[source], other.values_[source], count * sizeof(Vector4f));
    if (first_iterations_.has_value()) {
        const std::size_t bytes = count * sizeof(std::int32_t);
        other.first_iterations_ = PooledBuffer(device, bytes, "first iterations");
        copy_storage(device, first_iterations_, other.first_iterations_, bytes);
    }
    return other;
}

void GpuSmoother::plan_linear(const std::vector<LinearStep>& steps) {
    bool of_positions = true;
    for (const LinearStep& step : steps) {
        passes_.push_back({.program = &ring_program("linear_step"),
                           .factors = {step.umbrella, step.source, step.target, step.start},
                           .onto = static_cast<int>(step.onto),
                           .of_positions = of_positions});
        of_positions = step.onto != LinearStep::Onto::Zero;
    }
}

const Program& GpuSmoother::ring_program(const char* name) const {
    return surface_->program(name, surface_->rings(rings_).values.wide());
}

void GpuSmoother::plan(const LaplaceParameters& parameters) {
    plan_linear(linear_steps(parameters));
}

void GpuSmoother::plan(const LaplaceHcParameters& parameters) {
    plan_linear(linear_steps(parameters));
}

void GpuSmoother::plan(const TaubinParameters& parameters) {
    plan_linear(linear_steps(parameters));
}

void GpuSmoother::plan(const MeanCurvatureFlowParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    require_one_ring("mean curvature flow", {.rings = rings_});
    passes_.push_back({.program = &surface_->program("mean_curvature_flow"),
                       .factors = {parameters.lambda},
                       .by_corners = true});
}

void GpuSmoother::plan(const AnisotropicParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    require_one_ring("anisotropic smoothing", {.rings = rings_});
    const Surface& surface = surface_->surface();
    const double feature = parameters.feature_curvature.value_or(
        default_feature_curvature(*surface.topology, surface.points()));
    require_positive("feature_curvature", feature);
    passes_.push_back({.program = &surface_->program("anisotropic"),
                       .factors = {parameters.lambda},
                       .feature_curvature = feature,
                       .by_corners = true});
}

void GpuSmoother::plan(const CurvatureTriggeredParameters& parameters) {
    require_range("lambda", parameters.lambda, 0.0, 1.0);
    const Surface& surface = surface_->surface();
    const double trigger = parameters.trigger_curvature.value_or(
        default_trigger_curvature(*surface.topology, surface.points()));
    require_positive("trigger_curvature", trigger);
    find_first_iterations(trigger);
    passes_.push_back(
        {.program = &ring_program("triggered_laplace"), .factors = {parameters.lambda}});
}

void GpuSmoother::find_first_iterations(double trigger) {
    const Device& device = surface_->device();
    if (!first_iterations_.has_value())
        first_iterations_ = PooledBuffer(device, surface_->vertex_count() * sizeof(std::int32_t),
                                         "first iterations");
    const DeviceRows& corners = surface_->corners();
    bind_storage({&surface_->exact(), nullptr, start_->get(), &corners.offsets, &corners.values,
                  nullptr, nullptr, &first_iterations_});
    const Program& find = surface_->program("trigger");
    glUseProgram(find.id());
    glUniform1d(1, trigger);
    dispatch(device, find, surface_->vertex_count());
}

void GpuSmoother::set_weights(const Buffer& weights) {
    const std::size_t bytes = surface_->vertex_count() * sizeof(Vector4f);
    PooledBuffer start(surface_->device(), bytes, "start");
    bind_storage({start_->get(), &weights, &start});
    dispatch(surface_->device(), surface_->program("set_weights"), surface_->vertex_count());
    start_ = std::make_shared<const PooledBuffer>(std::move(start));
}

Buffer GpuSmoother::upload_weights(const DeviceSurface& surface, std::span<const double> weights) {
    if (weights.size() != surface.vertex_count())
        throw InvalidInput("got " + std::to_string(weights.size()) + " weights for " +
                           std::to_string(surface.vertex_count()) + " vertices");
    for (const double weight : weights) require_range("weight", weight, 0.0, 1.0);
    return make_vertices(surface, std::vector<float>(weights.begin(), weights.end()), "weights");
}

void GpuSmoother::set_weights(std::span<const double> weights) {
    set_weights(upload_weights(*surface_, weights));
}

void GpuSmoother::start(const FilterParameters& parameters) {
    require_context(surface_->device());
    passes_.clear();
    steps_done_ = 0;
    iterations_done_ = 0;
    copy_storage(surface_->device(), *start_, values_[0],
                 surface_->vertex_count() * sizeof(Vector4f));
    std::visit([&](const auto& filter) { plan(filter); }, parameters);
}

void GpuSmoother::run_pass(const Pass& pass, bool last) {
    const DeviceRows& rows = pass.by_corners ? surface_->corners() : surface_->rings(rings_);
    bind_storage(
        {&values_[steps_done_ % 2], &values_[(steps_done_ + 1) % 2], start_->get(), &rows.offsets,
         &rows.values, pass.by_corners ? nullptr : &surface_->anchor_umbrellas(rings_),
         &surface_->anchors(), first_iterations_.has_value() ? &first_iterations_ : nullptr});
    glUseProgram(pass.program->id());
    const Vector4f factors = Eigen::Vector4d(pass.factors.data()).cast<float>();
    glUniform4fv(Factors, 1, factors.data());
    glUniform1i(Onto, pass.onto);
    glUniform1i(Last, last ? 1 : 0);
    glUniform1i(OfPositions, pass.of_positions ? 1 : 0);
    glUniform1i(Iteration, iterations_done_);
    glUniform1i(Cell, 0);
    if (pass.feature_curvature > 0.0) glUniform1d(FeatureCurvature, pass.feature_curvature);
    if (last && constraint_) set_constraint(*constraint_);
    dispatch(surface_->device(), *pass.program, surface_->vertex_count());
    ++steps_done_;
}

void GpuSmoother::set_constraint(const PositionConstraint& constraint) {
    const Eigen::Vector3f half_size = (0.5 * constraint.size).cast<float>();
    const Eigen::Matrix3f axes = constraint.axes.cast<float>();
    glUniform1i(Cell, constraint.cell == PositionConstraint::Cell::Voxel ? 1 : 2);
    glUniform3fv(HalfSize, 1, half_size.data());
    glUniformMatrix3fv(CellAxes, 1, GL_FALSE, axes.data());
}

void GpuSmoother::run(int iterations, const Progress& progress) {
    // Iterations between two checks for cancellation; a device is fastest if the host never waits
    // for it.
    constexpr std::size_t kVertices = 20'000'000;
    const int batch = std::max(25, static_cast<int>(kVertices / surface_->vertex_count()));
    for (int i = 0; i < iterations; ++i) {
        if (i % batch == 0) {
            if (i > 0) finish_device();
            progress.report(static_cast<double>(i) / iterations, "smoothing");
        }
        for (const Pass& pass : passes_) run_pass(pass, &pass == &passes_.back());
        ++iterations_done_;
    }
    require_context(surface_->device());
}

Positions GpuSmoother::positions() const {
    const std::size_t count = surface_->vertex_count();
    const auto moved = read_storage<Vector4f>(surface_->device(), shifts(), count);
    const DeviceOrder& order = surface_->order();
    const Positions& start = surface_->surface().points();
    Positions result(count);
    for_each_vertex(count, [&](std::size_t v) {
        const DevicePoint from = device_point(start[v], surface_->centre());
        const Eigen::Vector3f shift = moved[order.place_of(v)].head<3>();
        result[v] =
            shift == from.shift
                ? start[v]
                : Vec3(surface_->centre() + from.anchor.cast<double>() + shift.cast<double>());
    });
    require_bounded(start, result);
    return result;
}

}  // namespace vesselbench
