#include "smoothing/quality/smoothing_space.h"

#include <cmath>
#include <utility>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr const char* kIterations = "iterations";

/// Both ends and whole steps between; rounded, so that equal values have equal bits.
std::vector<double> steps(double from, double to, double step) {
    std::vector<double> values;
    const auto count = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i <= count; ++i)
        values.push_back(std::round((from + step * i) * 1e6) / 1e6 + 0.0);
    return values;
}

SearchParameter share(const std::string& name, int coarse) {
    return {name, "-", steps(0.0, 1.0, 0.05), coarse};
}

/// The least beta with which the filter amplifies nothing, in steps of 0.05.
double least_beta(double lambda) {
    constexpr double kStep = 0.05;
    int steps = 0;
    while (amplifies(LaplaceHcParameters{.lambda = lambda, .beta = kStep * steps})) ++steps;
    return kStep * steps;
}

/// The filter's own parameters.
struct ParametersOf {
    bool all = false;
    bool staircase = false;  ///< then, unless all are asked for, alpha and beta are not searched

    std::vector<SearchParameter> operator()(const LaplaceHcParameters& p) const {
        if (staircase && !all) return {{"beta", "-", {least_beta(p.lambda)}}};
        std::vector<SearchParameter> list = {share("alpha", 4), share("beta", 4)};
        if (all) list.insert(list.begin(), share("lambda", 4));
        return list;
    }

    std::vector<SearchParameter> operator()(const TaubinParameters& p) const {
        std::vector<SearchParameter> list = {share("lambda", 2)};
        if (all) list.push_back({"mu", "-", steps(-p.lambda - 0.2, -p.lambda, 0.02), 2});
        return list;
    }

    template <class Curved>
    std::vector<SearchParameter> operator()(const Curved&) const {
        return {share("lambda", 2)};
    }
};

void set_value(FilterParameters& filter, const std::string& name, double value) {
    std::visit(
        [&](auto& p) {
            if (name == "lambda") p.lambda = value;
        },
        filter);
    if (auto* hc = std::get_if<LaplaceHcParameters>(&filter)) {
        if (name == "alpha") hc->alpha = value;
        if (name == "beta") hc->beta = value;
    }
    if (auto* taubin = std::get_if<TaubinParameters>(&filter))
        if (name == "mu") taubin->mu = value;
}

double value_in(const FilterParameters& filter, const std::string& name) {
    if (const auto* hc = std::get_if<LaplaceHcParameters>(&filter)) {
        if (name == "alpha") return hc->alpha;
        if (name == "beta") return hc->beta;
    }
    if (const auto* taubin = std::get_if<TaubinParameters>(&filter))
        if (name == "mu") return taubin->used_mu();
    return std::visit([](const auto& p) { return p.lambda; }, filter);
}

bool roughens(const FilterParameters& filter) {
    if (const auto* hc = std::get_if<LaplaceHcParameters>(&filter)) return amplifies(*hc);
    if (const auto* taubin = std::get_if<TaubinParameters>(&filter))
        return amplifies(*taubin) || taubin->used_mu() > -taubin->lambda;
    return false;
}

bool has(const std::vector<SearchParameter>& parameters, const std::string& name) {
    for (const SearchParameter& parameter : parameters)
        if (parameter.name == name) return true;
    return false;
}

/// The filter with the values of a set; a Taubin filter's mu follows lambda, unless it is a
/// parameter or fixed.
FilterParameters with_values(const std::vector<SearchParameter>& parameters,
                             std::span<const double> values, FilterParameters filter,
                             bool mu_stays) {
    if (auto* taubin = std::get_if<TaubinParameters>(&filter))
        if (!mu_stays && !has(parameters, "mu")) taubin->mu.reset();
    for (std::size_t i = 0; i < values.size(); ++i)
        if (parameters[i].name != kIterations) set_value(filter, parameters[i].name, values[i]);
    return filter;
}

std::vector<SearchParameter> parameters_for(const SmoothingSpaceOptions& options) {
    const bool staircase = options.staircase != nullptr;
    std::vector<SearchParameter> list =
        std::visit(ParametersOf{options.all_parameters, staircase}, options.filter);
    if (staircase && options.all_parameters) {
        list.push_back({"tau_theta", "-", steps(0.2, 0.9, 0.1), 3});
        list.push_back({"tau_max", "mm", {}, 2});
        for (const double slices : {0.5, 1.0, 1.5, 2.0, 3.0, 4.0})
            list.back().values.push_back(three_digits(slices * options.slice));
        list.push_back({"beta_min", "-", steps(0.0, 1.0, 0.1), 3});
    }
    list.push_back({kIterations, "", steps(0.0, options.most_iterations, 1.0), 5, 0.0});
    return list;
}

}  // namespace

SearchSpace smoothing_space(const SmoothingSpaceOptions& options) {
    SearchSpace space{.parameters = parameters_for(options)};
    if (options.staircase) space.volume_weight = kVolumeWeightOnStaircases;
    space.chooser = [parameters = space.parameters,
                     options](std::span<const double> values) -> std::optional<SmoothingChoice> {
        SmoothingChoice choice{with_values(parameters, values, options.filter, options.mu_stays),
                               options.weights};
        if (roughens(choice.filter)) return std::nullopt;
        if (!has(parameters, "tau_theta")) return choice;
        StaircaseValues staircase;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (parameters[i].name == "tau_theta") staircase.tau_theta = values[i];
            if (parameters[i].name == "tau_max") staircase.tau_max = values[i];
            if (parameters[i].name == "beta_min") staircase.beta_min = values[i];
        }
        if (options.engine_weighs)
            choice.staircase = std::make_shared<const SmoothingChoice::Staircase>(
                SmoothingChoice::Staircase{staircase, options.staircase});
        else
            choice.weights =
                options.staircase(staircase.tau_theta, staircase.tau_max, staircase.beta_min);
        return choice;
    };
    return space;
}

ParameterSet current_set(const SearchSpace& space, const FilterParameters& filter, int iterations,
                         const StaircaseValues& staircase) {
    ParameterSet set;
    for (const SearchParameter& parameter : space.parameters)
        set.push_back(parameter.name == kIterations   ? iterations
                      : parameter.name == "tau_theta" ? staircase.tau_theta
                      : parameter.name == "tau_max"   ? staircase.tau_max
                      : parameter.name == "beta_min"  ? staircase.beta_min
                                                      : value_in(filter, parameter.name));
    return set;
}

std::optional<double> value_of(const SearchSpace& space, const ParameterSet& set,
                               const std::string& name) {
    for (std::size_t i = 0; i < set.size(); ++i)
        if (space.parameters[i].name == name) return set[i];
    return std::nullopt;
}

}  // namespace vesselbench
