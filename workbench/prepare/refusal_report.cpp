#include "workbench/prepare/refusal_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/version.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/case_files.h"
#include "workbench/prepare/recipe_run.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// The preparation again, with the arguments that say what the input is.
Json prepare_command(const PrepareOptions& options) {
    Json command = {"vesselbench", "prepare", options.input.input};
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) command.insert(command.end(), {name, value});
    };
    add("--mask", options.input.mask);
    add("--mask-is", options.input.mask_is);
    add("--label", options.input.label);
    add("--units", options.input.units);
    for (const std::string& neighbour : options.input.neighbours) add("--neighbour", neighbour);
    add("--recipe", options.recipe);
    add("--author", options.author);
    add("--name", options.input.name);
    add("--for", options.purpose);
    add("--out", options.out.string());
    return command;
}

void add_setting(Json& command, const std::string& setting) {
    command.insert(command.end(), {"--set", setting});
}

/// "clip-opening" of "clip-opening.open=1,2,3", and "open".
std::string operation_of(const std::string& setting) {
    return setting.substr(0, setting.find('.'));
}

std::string parameter_of_setting(const std::string& setting) {
    const std::size_t from = operation_of(setting).size() + 1;
    return setting.substr(std::min(from, setting.size()), setting.find('=') - from);
}

/// The remedy has the value. One that names ends by their places names all of them.
bool replaces(const Remedy& remedy, const std::string& setting) {
    if (remedy.operation != operation_of(setting)) return false;
    const std::string name = parameter_of_setting(setting);
    const auto names_ends = [&](const NumberParameter& p) {
        return name == p.numbers || name == p.places;
    };
    const auto has_ends = [&](const NumberParameter& p) {
        return remedy.arguments.contains(p.places);
    };
    return remedy.arguments.contains(name) || (std::ranges::any_of(kNumberParameters, names_ends) &&
                                               std::ranges::any_of(kNumberParameters, has_ends));
}

/// True for an operation that reads the input: the preparation begins with it.
bool reads_input(const std::string& name) {
    const Operation* operation = known_operation(name);
    return operation != nullptr && operation->recipe.loads.has_value();
}

std::string project_of(const PrepareOptions& options) {
    return (options.out / kProjectFile).string();
}

void add_arguments(Json& command, const Remedy& remedy) {
    for (const auto& [name, value] : remedy.arguments) command.push_back(name + "=" + value);
}

/// An edit that comes before the step that failed.
Json apply_command(const PrepareOptions& options, const Remedy& remedy) {
    Json command = {"vesselbench", "apply", project_of(options), remedy.operation};
    add_arguments(command, remedy);
    for (const std::string& word : {std::string("--variant"), options.purpose})
        command.push_back(word);
    return command;
}

/// Of an edit that was made.
Json edit_command(const PrepareOptions& options, const Remedy& remedy, std::int64_t edit) {
    const bool remove = remedy.action == RemedyAction::Remove;
    Json command = {"vesselbench", remove ? "remove" : "change", project_of(options),
                    std::to_string(edit)};
    if (remedy.action == RemedyAction::ChooseAgain) command.push_back("--anew");
    add_arguments(command, remedy);
    return command;
}

/// True if the recipe has an entry that a setting is of.
bool comes(const Recipe& rest, const std::string& setting) {
    return std::ranges::any_of(rest, [&](const RecipeEntry& entry) {
        return entry.given.operation().name == operation_of(setting);
    });
}

/// What a preparation that stopped leaves.
struct Stopped {
    const Recipe& rest;
    bool kept = true;  ///< its project is there to go on with
};

/// \param remedy with its operation
Json commands_of(const PrepareOptions& options, const Stopped& stopped,
                 const Diagnostic& diagnostic, const Remedy& remedy) {
    Json again = prepare_command(options), commands = Json::array();
    const bool resumes = stopped.kept && !reads_input(diagnostic.operation);
    if (resumes) again.push_back("--resume");
    for (const std::string& setting : options.arguments)
        if ((!resumes || comes(stopped.rest, setting)) && !replaces(remedy, setting))
            add_setting(again, setting);
    if (remedy.before)
        commands.push_back(apply_command(options, remedy));
    else if (diagnostic.edit)
        commands.push_back(edit_command(options, remedy, *diagnostic.edit));
    else
        for (const auto& [name, value] : remedy.arguments)
            add_setting(again, remedy.operation + "." + name + "=" + value);
    commands.push_back(std::move(again));
    return commands;
}

/// True if it can be given as it is: to the step that failed, to its edit, or as an edit before it;
/// where no project is left, to any step of the preparation.
bool has_commands(const Stopped& stopped, const Diagnostic& diagnostic, const Remedy& remedy) {
    const bool of_edit = remedy.action != RemedyAction::Give;
    if (of_edit) return stopped.kept && diagnostic.edit.has_value();
    const bool own = remedy.operation.empty() ? !diagnostic.operation.empty()
                                              : remedy.operation == diagnostic.operation;
    const bool given = !remedy.arguments.empty() &&
                       (own || (!stopped.kept && !remedy.operation.empty() && !remedy.before));
    return ((remedy.before && stopped.kept) || given) &&
           std::ranges::none_of(remedy.arguments,
                                [](const auto& argument) { return argument.second.empty(); });
}

/// With the commands of each remedy.
Json with_commands(const PrepareOptions& options, const Diagnostic& diagnostic,
                   const Stopped& stopped) {
    Json json = diagnostic_json(diagnostic);
    for (std::size_t i = 0; i < diagnostic.remedies.size(); ++i) {
        Remedy remedy = diagnostic.remedies[i];
        if (!has_commands(stopped, diagnostic, remedy)) continue;
        if (remedy.operation.empty()) remedy.operation = diagnostic.operation;
        json["remedies"][i]["commands"] = commands_of(options, stopped, diagnostic, remedy);
    }
    return json;
}

}  // namespace

Json refused_json(const PrepareOptions& options, const std::exception& error, const Recipe& rest) {
    const bool unusable = dynamic_cast<const UnusableSource*>(&error) != nullptr;
    const Stopped stopped{.rest = rest, .kept = options.resume || !unusable};
    Json diagnostics = Json::array();
    for (const Diagnostic& diagnostic : diagnostics_of(error))
        diagnostics.push_back(with_commands(options, diagnostic, stopped));
    return diagnostics;
}

Json refusal_json(const PrepareOptions& options, const std::exception& error,
                  const std::vector<std::string>& earlier_results, const Recipe& rest) {
    return {
        {"program_version", version()},
        {"purpose", options.purpose},
        {"stopped", {{"text", error.what()}, {"diagnostics", refused_json(options, error, rest)}}},
        {"earlier_results", earlier_results}};
}

}  // namespace vesselbench
