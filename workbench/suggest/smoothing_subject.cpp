#include "workbench/suggest/smoothing_subject.h"

#include <array>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "workbench/operations/smooth/context.h"
#include "workbench/operations/smooth/filter_choice.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWeightsKept = 64;  // sets of staircase weights in memory

std::shared_ptr<const std::vector<double>> shared_weights(std::vector<double> weights) {
    if (weights.empty()) return nullptr;
    return std::make_shared<const std::vector<double>>(std::move(weights));
}

/// Weights of `smooth` for other thresholds; the last ones are kept.
StaircaseWeights staircase_weights_of(const Scene& scene, const Arguments& arguments) {
    using Key = std::array<double, 3>;
    auto known = std::make_shared<std::map<Key, std::shared_ptr<const std::vector<double>>>>();
    return [scene, arguments, known](double tau_theta, double tau_max, double beta_min) {
        const Key key = {tau_theta, tau_max, beta_min};
        if (const auto at = known->find(key); at != known->end()) return at->second;
        Arguments changed = arguments;
        changed.set("tau_theta", tau_theta);
        changed.set("tau_max", tau_max);
        changed.set("beta_min", beta_min);
        Json report;
        if (known->size() >= kWeightsKept) known->clear();
        return (*known)[key] = shared_weights(smoothing_context(scene, changed, report).weights);
    };
}

/// None where caps are rounded: staircases are those of the surface before.
/// \param caps 1 at their vertices
std::optional<StaircaseGround> staircase_ground_of(const Scene& scene, const Arguments& arguments,
                                                   const std::vector<std::uint8_t>& caps) {
    if (arguments.text("caps") == "round") return std::nullopt;
    StaircaseGround ground{.stack_axis = arguments.point("stack_axis"),
                           .caps = caps,
                           .scaling = arguments.text("weight") == "thesis"
                                          ? StaircaseScaling::Thesis
                                          : StaircaseScaling::TauMax};
    if (arguments.text("distance") == "none" && !arguments.has("painted")) return ground;
    Arguments others = arguments;
    others.set("staircase", false);
    Json report;
    ground.others = shared_weights(smoothing_context(scene, others, report).weights);
    return ground;
}

}  // namespace

SmoothingSubject smoothing_subject(const Scene& scene, Arguments& arguments) {
    const Surface& surface = surface_of(scene);
    resolve_filter(surface, arguments);
    SmoothingSubject subject{.filter = filter_from(arguments)};
    Json report;
    SmoothingContext context = smoothing_context(scene, arguments, report);
    subject.weights = shared_weights(std::move(context.weights));
    subject.ground = {.topology = surface.topology,
                      .start = context.start,
                      .fixed = std::move(context.fixed),
                      .constraint = context.constraint,
                      .rings = static_cast<int>(arguments.integer("rings"))};
    if (scene.sampling) subject.slice = scene.sampling->spacing.z();
    if (arguments.flag("staircase")) {
        subject.staircase = staircase_weights_of(scene, arguments);
        subject.staircase_ground = staircase_ground_of(scene, arguments, subject.ground.fixed);
    }
    return subject;
}

ChosenEngine smoothing_engine(const SmoothingSubject& subject, const Arguments& arguments,
                              bool planes) {
    const std::string& device = arguments.text("device");
    const DeviceChoice choice = device == "gpu"   ? DeviceChoice::Gpu
                                : device == "cpu" ? DeviceChoice::Cpu
                                                  : DeviceChoice::Auto;
    return make_engine(choice, subject.ground, planes, offscreen_device, subject.staircase_ground);
}

SearchSpace smoothing_space_for(const SmoothingSubject& subject, const SmoothingEngine& engine,
                                bool all_parameters) {
    return smoothing_space({.filter = subject.filter,
                            .weights = subject.weights,
                            .staircase = subject.staircase,
                            .engine_weighs = engine.weighs_staircases(),
                            .slice = subject.slice,
                            .all_parameters = all_parameters});
}

ParameterSet smoothing_set(const SmoothingSubject& subject, const Arguments& arguments,
                           const SearchSpace& space) {
    return current_set(space, subject.filter, static_cast<int>(arguments.integer("iterations")),
                       {.tau_theta = arguments.real("tau_theta"),
                        .tau_max = arguments.real("tau_max"),
                        .beta_min = arguments.real("beta_min")});
}

Surface smoothed_with(const SmoothingSubject& subject, const Surface& surface,
                      const SearchSpace& space, const ParameterSet& set, const Progress& progress) {
    const auto choice = space.chooser(std::span(set.data(), set.size() - 1));
    if (!choice) throw InvalidInput("these parameters would roughen the surface");
    FilterRun run(FilterRun::prepare(subject.ground), choice->filter, weights_of(*choice));
    run.advance(static_cast<int>(set.back()), progress);
    Positions moved;
    run.write_positions(moved);
    return surface.with_positions(std::move(moved));
}

}  // namespace vesselbench
