#include "workbench/suggest/search_subject.h"

#include <array>
#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "workbench/argument_texts.h"
#include "workbench/foreign_surface.h"
#include "workbench/operation.h"
#include "workbench/operations/smooth/context.h"
#include "workbench/operations/smooth/filter_choice.h"
#include "workbench/session.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWeightsKept = 64;  // sets of staircase weights in memory

void take_project(const std::string& file, SearchSubject& subject, const Progress& progress) {
    Session session = Session::open(file);
    const std::vector<LogEntry> log = session.log();
    const LogEntry* last = nullptr;
    for (const LogEntry& entry : log) {
        if (entry.edit.place.step > Step::Smoothing) break;
        last = &entry;
        if (entry.edit.operation == "smooth")
            subject.notes.push_back("edit " + std::to_string(entry.edit.edit.id) +
                                    " has smoothed the surface already: the suggestion is for "
                                    "what to do on top of it (undo goes back to before it)");
    }
    if (last == nullptr) throw InvalidInput(subject.name + " holds no edit that made a surface");
    subject.is_project = true;
    subject.state = "after edit " + std::to_string(last->edit.edit.id) + " " + last->edit.operation;
    subject.scene = session.scene_after(last->edit.edit.id, progress);
}

Arguments given_arguments(const SubjectOptions& options) {
    std::vector<std::string> texts = options.arguments;
    if (!options.filter.empty()) texts.push_back("filter=" + options.filter);
    return arguments_from_texts(find_operation("smooth"), texts);
}

void set_values(Arguments& arguments, const SearchSpace& space, const ParameterSet& set) {
    for (std::size_t i = 0; i < set.size(); ++i)
        if (space.parameters[i].name == "iterations")
            arguments.set("iterations", static_cast<std::int64_t>(set[i]));
        else
            arguments.set(space.parameters[i].name, set[i]);
}

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

}  // namespace

SearchSubject search_subject(const SubjectOptions& options, const Progress& progress) {
    SearchSubject subject;
    subject.name = std::filesystem::path(options.source).filename().string();
    subject.given = given_arguments(options);
    subject.arguments = checked_arguments(find_operation("smooth"), subject.given);
    if (options.source.ends_with(".vbench"))
        take_project(options.source, subject, progress);
    else
        subject.scene.surface =
            read_foreign_surface(options.source, options.units, progress.part(0.0, 0.1));
    const Surface& surface = surface_of(subject.scene);
    resolve_filter(surface, subject.arguments);
    subject.filter = filter_from(subject.arguments);
    Json report;
    SmoothingContext context = smoothing_context(subject.scene, subject.arguments, report);
    subject.weights = shared_weights(std::move(context.weights));
    subject.ground = {.topology = surface.topology,
                      .start = context.start,
                      .fixed = std::move(context.fixed),
                      .constraint = context.constraint,
                      .rings = static_cast<int>(subject.arguments.integer("rings"))};
    if (subject.scene.sampling) subject.slice = subject.scene.sampling->spacing.z();
    if (subject.arguments.flag("staircase"))
        subject.staircase = staircase_weights_of(subject.scene, subject.arguments);
    return subject;
}

ChosenEngine engine_for(const SearchSubject& subject, bool planes) {
    const std::string& device = subject.arguments.text("device");
    const DeviceChoice choice = device == "gpu"   ? DeviceChoice::Gpu
                                : device == "cpu" ? DeviceChoice::Cpu
                                                  : DeviceChoice::Auto;
    return make_engine(choice, subject.ground, planes);
}

SearchSpace space_for(const SearchSubject& subject, bool all_parameters) {
    return smoothing_space({.filter = subject.filter,
                            .weights = subject.weights,
                            .staircase = subject.staircase,
                            .slice = subject.slice,
                            .all_parameters = all_parameters});
}

ParameterSet given_set(const SearchSubject& subject, const SearchSpace& space) {
    return current_set(space, subject.filter,
                       static_cast<int>(subject.arguments.integer("iterations")),
                       {.tau_theta = subject.arguments.real("tau_theta"),
                        .tau_max = subject.arguments.real("tau_max"),
                        .beta_min = subject.arguments.real("beta_min")});
}

Arguments arguments_of(const SearchSubject& subject, const SearchSpace& space,
                       const ParameterSet& set) {
    Arguments arguments = subject.arguments;
    set_values(arguments, space, set);
    if (arguments.text("filter") == "taubin" && !value_of(space, set, "mu")) {
        arguments.remove("mu");
        resolve_filter(surface_of(subject.scene), arguments);
    }
    return arguments;
}

Arguments typed_arguments(const SearchSubject& subject, const SearchSpace& space,
                          const ParameterSet& set) {
    Arguments arguments = subject.given;
    arguments.set("filter", subject.arguments.text("filter"));
    if (std::holds_alternative<TaubinParameters>(subject.filter)) arguments.remove("mu");
    set_values(arguments, space, set);
    return arguments;
}

Surface smoothed_with(const SearchSubject& subject, const SearchSpace& space,
                      const ParameterSet& set, const Progress& progress) {
    const auto choice = space.chooser(std::span(set.data(), set.size() - 1));
    const Surface& surface = surface_of(subject.scene);
    if (!choice) throw InvalidInput("these parameters would roughen the surface");
    FilterRun run(FilterRun::prepare(subject.ground), choice->filter, choice->weights);
    run.advance(static_cast<int>(set.back()), progress);
    Positions moved;
    run.write_positions(moved);
    return surface.with_positions(std::move(moved));
}

}  // namespace vesselbench
