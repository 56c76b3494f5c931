#include "workbench/operations/smooth/search.h"

#include <array>
#include <map>
#include <mutex>
#include <utility>

#include "smoothing/context/staircases.h"
#include "workbench/operations/shared/context_weights.h"
#include "workbench/operations/smooth/context.h"
#include "workbench/operations/smooth/filter_choice.h"

namespace vesselbench {

namespace {

constexpr std::size_t kWeightsKept = 64;  // sets of staircase weights or distances in memory

SharedWeights shared_weights(std::vector<double> weights) {
    if (weights.empty()) return nullptr;
    return std::make_shared<const std::vector<double>>(std::move(weights));
}

/// What the thresholds of staircases do not change.
struct OtherWeights {
    StaircaseGround ground;
    SharedWeights averaged;  ///< distances, if they are averaged with the staircases; null: none
    double cap_weight = 0.0;
};

/// The weights of `smooth` without staircases.
SharedWeights without_staircases(const Scene& scene, ContextFinder& finder, Arguments arguments) {
    arguments.set("staircase", false);
    return shared_weights(smoothing_context(scene, finder, arguments).weights);
}

OtherWeights other_weights(const Scene& scene, ContextFinder& finder, const Arguments& arguments,
                           const SmoothingContext& context) {
    OtherWeights others{.ground = {.stack_axes = *context.stack_axes,
                                   .caps = context.caps,
                                   .scaling = context.thesis_scaling ? StaircaseScaling::Thesis
                                                                     : StaircaseScaling::TauMax},
                        .cap_weight = context.cap_weight()};
    Arguments multiplied = arguments;
    if (arguments.text("distance") != "none" &&
        combination_from(arguments) == Combination::Average) {
        multiplied.set("distance", std::string("none"));
        Arguments averaged = arguments;
        averaged.remove("painted");
        others.averaged = without_staircases(scene, finder, averaged);
    }
    if (multiplied.text("distance") != "none" || multiplied.has("painted"))
        others.ground.others = without_staircases(scene, finder, multiplied);
    return others;
}

/// Weights of `smooth` for other thresholds. Everything independent of them is computed once; the
/// last distances and weights are kept.
class WeightsOfThresholds {
public:
    WeightsOfThresholds(const Surface& surface, OtherWeights others)
        : surface_(surface),
          others_(std::move(others)),
          change_(
              orientation_change(*surface.topology, surface.points(), others_.ground.stack_axes)) {}

    [[nodiscard]] SharedWeights operator()(double tau_theta, double tau_max, double beta_min) {
        const std::lock_guard lock(mutex_);
        const std::array<double, 3> key = {tau_theta, tau_max, beta_min};
        if (const auto at = weights_.find(key); at != weights_.end()) return at->second;
        if (weights_.size() >= kWeightsKept) weights_.clear();
        return weights_[key] = shared_weights(made({.tau_theta = tau_theta,
                                                    .tau_max = tau_max,
                                                    .beta_min = beta_min,
                                                    .scaling = others_.ground.scaling,
                                                    .caps = others_.ground.caps}));
    }

private:
    std::vector<double> made(const StaircaseParameters& parameters) {
        std::vector<double> weights = weights_of_distances(distances(parameters), parameters);
        const auto& [ground, averaged, cap_weight] = others_;
        for (std::size_t v = 0; v < weights.size(); ++v) {
            if (averaged)
                weights[v] = combined_weight(weights[v], (*averaged)[v], Combination::Average);
            if (ground.others) weights[v] *= (*ground.others)[v];
            if (ground.caps[v] != 0) weights[v] = cap_weight;  // whatever the others are
        }
        return weights;
    }

    const std::vector<double>& distances(const StaircaseParameters& parameters) {
        const std::array<double, 2> key = {parameters.tau_theta, parameters.tau_max};
        if (const auto at = distances_.find(key); at != distances_.end()) return at->second;
        if (distances_.size() >= kWeightsKept) distances_.clear();
        return distances_[key] =
                   staircase_distances(*surface_.topology, surface_.points(), change_, parameters);
    }

    std::mutex mutex_;
    Surface surface_;
    OtherWeights others_;
    std::vector<double> change_;  ///< of orientation, #V
    std::map<std::array<double, 2>, std::vector<double>> distances_;
    std::map<std::array<double, 3>, SharedWeights> weights_;
};

/// The filter's part of the subject.
SmoothingSubject filter_of(const Scene& scene, const Arguments& given, Arguments& arguments) {
    resolve_filter(scene, arguments);
    SmoothingSubject subject{.filter = filter_from(arguments),
                             .iterations = static_cast<int>(arguments.integer("iterations")),
                             .device = device_choice_from(arguments.text("device")),
                             .mu_stays = given.has("mu")};
    if (std::holds_alternative<TaubinParameters>(subject.filter) && !subject.mu_stays) {
        subject.followers = {"mu"};
        subject.decide = [scene](Arguments& changed) { resolve_filter(scene, changed); };
    }
    return subject;
}

}  // namespace

SmoothingSubject smoothing_subject(const Scene& scene, const Arguments& given,
                                   Arguments& arguments) {
    SmoothingSubject subject = filter_of(scene, given, arguments);
    const Surface& surface = surface_of(scene);
    const auto finder = make_cpu_finder(surface);
    SmoothingContext context = smoothing_context(scene, *finder, arguments);
    subject.weights = shared_weights(std::move(context.weights));
    subject.ground = {.topology = surface.topology,
                      .start = context.start,
                      .fixed = std::move(context.fixed),
                      .constraint = context.constraint,
                      .rings = static_cast<int>(arguments.integer("rings"))};
    if (arguments.flag("staircase")) {
        subject.thresholds = {.tau_theta = arguments.real("tau_theta"),
                              .tau_max = arguments.real("tau_max"),
                              .beta_min = arguments.real("beta_min")};
        subject.slice = subject.thresholds.tau_max;
        OtherWeights others = other_weights(scene, *finder, arguments, context);
        // A GPU would find the staircases of the rounded surface, and it averages nothing.
        if (!context.caps_rounded && !others.averaged) subject.staircase_ground = others.ground;
        const auto weights = std::make_shared<WeightsOfThresholds>(surface, std::move(others));
        subject.staircase = [weights](double tau_theta, double tau_max, double beta_min) {
            return (*weights)(tau_theta, tau_max, beta_min);
        };
    }
    return subject;
}

}  // namespace vesselbench
