#include "workbench/operations/smooth/filter_choice.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Defaults of arguments that are not given.
struct Preset {
    const char* name;
    const char* filter;
    std::int64_t iterations;
    double lambda;
    double beta_min;               ///< with staircase awareness
    bool keeps_distances = false;  ///< to neighbours, where they are loaded (Table 2.1)
};

/// Laplace+HC and LowPass (Taubin) suit anatomy according to Bade et al., depending on shape
/// (thesis 3.3.4); the strength follows from Table 2.1: little where small features and spatial
/// relations matter, much where only smoothness does.
constexpr std::array kPresets = {
    Preset{"none", "laplace-hc", 20, 0.5, 0.0},
    Preset{"compact", "laplace-hc", 30, 0.5, 0.1},
    Preset{"flat", "laplace-hc", 10, 0.5, 0.1},
    Preset{"elongated", "taubin", 20, 0.5, 0.1},
    Preset{"planning", "laplace-hc", 20, 0.5, 0.1, true},
    Preset{"simulation", "taubin", 40, 0.5, 0.5},
    Preset{"cfd", "laplace-hc", 20, 0.5, 0.2},
    Preset{"rp", "laplace-hc", 20, 0.5, 0.2},
};

const Preset& preset_of(const Arguments& arguments) {
    const std::string& name = arguments.text("preset");
    return *std::ranges::find_if(kPresets, [&](const Preset& p) { return name == p.name; });
}

/// The values of the presets: "flat: laplace-hc 10, 0.1".
std::string preset_values() {
    std::ostringstream text;
    for (const Preset& p : kPresets)
        text << (&p == kPresets.data() ? "" : "; ") << p.name << ": " << p.filter << " "
             << p.iterations << ", " << p.beta_min;
    return text.str();
}

void set_default(Arguments& arguments, const std::string& name, Value value) {
    if (!arguments.has(name)) arguments.set(name, std::move(value));
}

void check_mu(const Arguments& arguments) {
    const double lambda = arguments.real("lambda"), mu = arguments.real("mu");
    if (mu <= -lambda) return;
    std::ostringstream text;
    text << "smooth: mu = " << mu << " must be at most -lambda = " << -lambda
         << "; mu is negative, by default -1.02 * lambda";
    throw UsageError(text.str());
}

/// The parameters of the filters.
std::vector<Parameter> strength_parameters() {
    return {
        {.name = "lambda",
         .unit = "-",
         .help = "fraction of the way to its neighbours' mean that a vertex moves per pass; "
                 "default 0.5",
         .minimum = 0.0,
         .maximum = 1.0},
        {.name = "mu",
         .unit = "-",
         .help = "the inflating step that undoes the shrinking: negative, at most -lambda; default "
                 "-1.02 lambda",
         .minimum = -2.0,
         .maximum = 0.0,
         .only_with = Condition{"filter", {"taubin"}}},
        {.name = "alpha",
         .unit = "-",
         .default_value = 0.0,
         .help = "target of the pull-back after a pass: 1 the original positions, 0 those before "
                 "the pass, in between a mixture. 0 smooths more",
         .minimum = 0.0,
         .maximum = 1.0,
         .only_with = Condition{"filter", {"laplace-hc"}},
         .use = Use::Rare},
        {.name = "beta",
         .unit = "-",
         .default_value = 0.5,
         .help = "fraction of the pull-back taken from the vertex itself, the rest from its "
                 "neighbours' mean; 1 undoes the smoothing, smaller values smooth more and, with "
                 "lambda above 0.5, may roughen",
         .minimum = 0.0,
         .maximum = 1.0,
         .only_with = Condition{"filter", {"laplace-hc"}},
         .use = Use::Rare},
        {.name = "curvature",
         .unit = "1/mm",
         .help = "anisotropic: edges of larger curvature are preserved; curvature-triggered: "
                 "smoothing starts where the mean curvature is larger. 1 is the curvature of a rod "
                 "of 1 mm radius; default: half a radian (triggered: a quarter) per mean edge",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"filter", {"anisotropic", "curvature-triggered"}}}};
}

}  // namespace

bool is_preset(const std::string& name) {
    return std::ranges::any_of(kPresets, [&](const Preset& preset) { return name == preset.name; });
}

std::vector<Parameter> filter_parameter_table() {
    using enum ParameterType;
    std::vector<std::string> presets;
    for (const Preset& preset : kPresets) presets.push_back(preset.name);
    std::vector<Parameter> table = {
        {.name = "preset",
         .type = Choice,
         .default_value = std::string("none"),
         .help = "defaults of filter, iterations and beta_min for compact organs, flat muscles, "
                 "elongated vessels, or a use of the model: " +
                 preset_values(),
         .choices = presets},
        {.name = "filter",
         .type = Choice,
         .help =
             "laplace shrinks the vessel, laplace-hc (the default without a preset) hardly does, "
             "taubin preserves the volume; mean-curvature-flow does not move vertices along the "
             "surface; anisotropic preserves sharp edges; curvature-triggered starts at them",
         .choices = {"laplace", "laplace-hc", "taubin", "mean-curvature-flow", "anisotropic",
                     "curvature-triggered"}},
        {.name = "iterations",
         .type = Integer,
         .help = "number of passes; more passes smooth more",
         .minimum = 0,
         .maximum = 10000}};
    for (Parameter& parameter : strength_parameters()) table.push_back(std::move(parameter));
    table.push_back(
        {.name = "rings",
         .type = Integer,
         .default_value = std::int64_t{1},
         .help = "rings of neighbours to average; 2 is less sensitive to small features",
         .minimum = 1,
         .maximum = 2,
         .use = Use::Rare});
    return table;
}

void resolve_filter(const Scene& scene, Arguments& arguments) {
    const Surface& surface = surface_of(scene);
    const Preset& preset = preset_of(arguments);
    set_default(arguments, "filter", std::string(preset.filter));
    set_default(arguments, "iterations", preset.iterations);
    set_default(arguments, "lambda", preset.lambda);
    set_default(arguments, "beta_min", preset.beta_min);
    const bool aware = preset.keeps_distances && !scene.neighbours.empty();
    set_default(arguments, "distance", std::string(aware ? "linear" : "none"));
    const std::string& filter = arguments.text("filter");
    if (filter == "taubin") {
        set_default(arguments, "mu",
                    TaubinParameters{.lambda = arguments.real("lambda")}.used_mu());
        check_mu(arguments);
    }
    if (filter == "anisotropic")
        set_default(arguments, "curvature",
                    default_feature_curvature(*surface.topology, surface.points()));
    if (filter == "curvature-triggered")
        set_default(arguments, "curvature",
                    default_trigger_curvature(*surface.topology, surface.points()));
    const bool by_edges = filter == "mean-curvature-flow" || filter == "anisotropic";
    if (by_edges && arguments.integer("rings") != 1)
        throw UsageError("smooth: rings = 2 cannot be combined with filter=" + filter +
                         ", whose weights belong to edges");
}

FilterParameters filter_from(const Arguments& resolved) {
    const double lambda = resolved.real("lambda");
    const std::string& filter = resolved.text("filter");
    if (filter == "laplace") return LaplaceParameters{lambda};
    if (filter == "taubin") return TaubinParameters{lambda, resolved.real("mu")};
    if (filter == "mean-curvature-flow") return MeanCurvatureFlowParameters{lambda};
    if (filter == "anisotropic") return AnisotropicParameters{lambda, resolved.real("curvature")};
    if (filter == "curvature-triggered")
        return CurvatureTriggeredParameters{lambda, resolved.real("curvature")};
    return LaplaceHcParameters{lambda, resolved.real("alpha"), resolved.real("beta")};
}

std::optional<Diagnostic> filter_warning(const FilterParameters& filter) {
    const auto* hc = std::get_if<LaplaceHcParameters>(&filter);
    if (hc != nullptr && amplifies(*hc)) return Diagnostic{.code = "filter-roughens"};
    const auto* taubin = std::get_if<TaubinParameters>(&filter);
    if (taubin != nullptr && amplifies(*taubin))
        return Diagnostic{.code = "filter-amplifies",
                          .remedies = {{.arguments = {{"lambda", "0.5"}}}}};
    return std::nullopt;
}

}  // namespace vesselbench
