#include "workbench/prepare/refusal_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/version.h"
#include "workbench/prepare/case_files.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json resume_command(const PrepareOptions& options) {
    Json command = {"vesselbench", "prepare", options.input.input};
    if (!options.input.mask.empty()) command.insert(command.end(), {"--mask", options.input.mask});
    if (!options.recipe.empty()) command.insert(command.end(), {"--recipe", options.recipe});
    if (!options.author.empty()) command.insert(command.end(), {"--author", options.author});
    if (!options.input.name.empty()) command.insert(command.end(), {"--name", options.input.name});
    for (const char* part : {"--for", options.purpose.c_str(), "--out"}) command.push_back(part);
    command.push_back(options.out.string());
    command.push_back("--resume");
    for (const std::string& setting : options.arguments)
        if (setting.starts_with("clip-opening.")) {
            command.push_back("--set");
            command.push_back(setting);
        }
    return command;
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

/// \param remedy with its operation
Json commands_of(const PrepareOptions& options, const Diagnostic& diagnostic,
                 const Remedy& remedy) {
    Json resume = resume_command(options), commands = Json::array();
    if (remedy.before)
        commands.push_back(apply_command(options, remedy));
    else if (diagnostic.edit)
        commands.push_back(edit_command(options, remedy, *diagnostic.edit));
    else
        for (const auto& [name, value] : remedy.arguments) {
            resume.push_back("--set");
            resume.push_back(remedy.operation + "." + name + "=" + value);
        }
    commands.push_back(std::move(resume));
    return commands;
}

/// True if it can be given as it is: to the step that failed, to its edit, or as an edit before it.
bool has_commands(const Diagnostic& diagnostic, const Remedy& remedy) {
    if (remedy.action != RemedyAction::Give) return diagnostic.edit.has_value();
    const bool own = remedy.operation.empty() || remedy.operation == diagnostic.operation;
    return (own || remedy.before) && !remedy.arguments.empty() &&
           std::ranges::none_of(remedy.arguments,
                                [](const auto& argument) { return argument.second.empty(); });
}

/// With the commands of each remedy.
Json with_commands(const PrepareOptions& options, const Diagnostic& diagnostic) {
    Json json = diagnostic_json(diagnostic);
    for (std::size_t i = 0; i < diagnostic.remedies.size(); ++i) {
        Remedy remedy = diagnostic.remedies[i];
        if (!has_commands(diagnostic, remedy)) continue;
        if (remedy.operation.empty()) remedy.operation = diagnostic.operation;
        json["remedies"][i]["commands"] = commands_of(options, diagnostic, remedy);
    }
    return json;
}

}  // namespace

Json refusal_json(const PrepareOptions& options, const DiagnosedFailure& failure,
                  const std::vector<std::string>& earlier_results) {
    Json diagnostics = Json::array();
    for (const Diagnostic& diagnostic : failure.diagnostics())
        diagnostics.push_back(with_commands(options, diagnostic));
    return {{"program_version", version()},
            {"purpose", options.purpose},
            {"stopped", {{"text", failure.what()}, {"diagnostics", std::move(diagnostics)}}},
            {"earlier_results", earlier_results}};
}

}  // namespace vesselbench
