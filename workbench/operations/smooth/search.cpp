#include "workbench/operations/smooth/search.h"

#include <array>
#include <map>
#include <mutex>
#include <utility>

#include "smoothing/context/staircases.h"
#include "workbench/operations/smooth/context.h"
#include "workbench/operations/smooth/filter_choice.h"

namespace vesselbench {

namespace {

constexpr std::size_t kWeightsKept = 64;  // sets of staircase weights or distances in memory

SharedWeights shared_weights(std::vector<double> weights) {
    if (weights.empty()) return nullptr;
    return std::make_shared<const std::vector<double>>(std::move(weights));
}

StaircaseGround staircase_ground_of(const Scene& scene, ContextFinder& finder,
                                    const Arguments& arguments, const SmoothingContext& context) {
    StaircaseGround ground{
        .stack_axis = arguments.point("stack_axis"),
        .caps = context.caps,
        .scaling = context.thesis_scaling ? StaircaseScaling::Thesis : StaircaseScaling::TauMax};
    if (arguments.text("distance") == "none" && !arguments.has("painted")) return ground;
    Arguments others = arguments;
    others.set("staircase", false);
    ground.others = shared_weights(smoothing_context(scene, finder, others).weights);
    return ground;
}

/// Weights of `smooth` for other thresholds. Everything independent of them is computed once; the
/// last distances and weights are kept.
class WeightsOfThresholds {
public:
    /// \param cap_weight of the caps' vertices, whatever their other weights
    WeightsOfThresholds(const Surface& surface, StaircaseGround ground, double cap_weight)
        : surface_(surface),
          ground_(std::move(ground)),
          cap_weight_(cap_weight),
          change_(orientation_change(*surface.topology, surface.points(), ground_.stack_axis)) {}

    [[nodiscard]] SharedWeights operator()(double tau_theta, double tau_max, double beta_min) {
        const std::lock_guard lock(mutex_);
        const std::array<double, 3> key = {tau_theta, tau_max, beta_min};
        if (const auto at = weights_.find(key); at != weights_.end()) return at->second;
        if (weights_.size() >= kWeightsKept) weights_.clear();
        return weights_[key] = shared_weights(made({.tau_theta = tau_theta,
                                                    .tau_max = tau_max,
                                                    .beta_min = beta_min,
                                                    .scaling = ground_.scaling,
                                                    .caps = ground_.caps}));
    }

private:
    std::vector<double> made(const StaircaseParameters& parameters) {
        std::vector<double> weights = weights_of_distances(distances(parameters), parameters);
        for (std::size_t v = 0; v < weights.size(); ++v)
            if (ground_.caps[v] != 0)
                weights[v] = cap_weight_;
            else if (ground_.others)
                weights[v] *= (*ground_.others)[v];
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
    StaircaseGround ground_;
    double cap_weight_ = 0.0;
    std::vector<double> change_;  ///< of orientation, #V
    std::map<std::array<double, 2>, std::vector<double>> distances_;
    std::map<std::array<double, 3>, SharedWeights> weights_;
};

/// The filter's part of the subject.
SmoothingSubject filter_of(const Surface& surface, const Arguments& given, Arguments& arguments) {
    resolve_filter(surface, arguments);
    SmoothingSubject subject{.filter = filter_from(arguments),
                             .iterations = static_cast<int>(arguments.integer("iterations")),
                             .device = device_choice_from(arguments.text("device")),
                             .mu_stays = given.has("mu")};
    if (std::holds_alternative<TaubinParameters>(subject.filter) && !subject.mu_stays) {
        subject.followers = {"mu"};
        subject.decide = [surface](Arguments& changed) { resolve_filter(surface, changed); };
    }
    return subject;
}

}  // namespace

SmoothingSubject smoothing_subject(const Scene& scene, const Arguments& given,
                                   Arguments& arguments) {
    SmoothingSubject subject = filter_of(surface_of(scene), given, arguments);
    const Surface& surface = surface_of(scene);
    const auto finder = make_cpu_finder(surface);
    SmoothingContext context = smoothing_context(scene, *finder, arguments);
    subject.thresholds = {.tau_theta = arguments.real("tau_theta"),
                          .tau_max = arguments.real("tau_max"),
                          .beta_min = arguments.real("beta_min")};
    subject.weights = shared_weights(std::move(context.weights));
    subject.ground = {.topology = surface.topology,
                      .start = context.start,
                      .fixed = std::move(context.fixed),
                      .constraint = context.constraint,
                      .rings = static_cast<int>(arguments.integer("rings"))};
    if (scene.sampling) subject.slice = scene.sampling->spacing.z();
    if (arguments.flag("staircase")) {
        StaircaseGround ground = staircase_ground_of(scene, *finder, arguments, context);
        // A GPU would find the staircases of the rounded surface.
        if (!context.caps_rounded) subject.staircase_ground = ground;
        const auto weights =
            std::make_shared<WeightsOfThresholds>(surface, std::move(ground), context.cap_weight());
        subject.staircase = [weights](double tau_theta, double tau_max, double beta_min) {
            return (*weights)(tau_theta, tau_max, beta_min);
        };
    }
    return subject;
}

}  // namespace vesselbench
