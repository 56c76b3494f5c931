#include "workbench/suggest/search_subject.h"

#include <filesystem>

#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/operations/table.h"
#include "workbench/project/project.h"
#include "workbench/session/edit_place.h"
#include "workbench/session/session.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/suggest/smoothing_search.h"

namespace vesselbench {

namespace {

void take_project(const SubjectOptions& options, SearchSubject& subject, const Progress& progress) {
    Session session = Session::open(options.source, {.find = find_operation});
    const Operation& operation = *subject.operation;
    const std::string variant = variant_meant(options.variant, *session.snapshot()->history);
    const std::vector<LogEntry> log = session.log(variant);
    const LogEntry* last = nullptr;
    for (const LogEntry& entry : log) {
        if (entry.edit.place.step > operation.usual_step) break;
        last = &entry;
        if (entry.edit.operation == operation.name)
            subject.notes.push_back(
                "edit " + std::to_string(entry.edit.edit.id) + " is a " + operation.name +
                " already: the suggestion applies on top of it (use undo to return to before it)");
    }
    if (last == nullptr) throw AlgorithmFailure(subject.name + " has no edit that makes a surface");
    subject.is_project = true;
    if (belongs_to_variant(operation.usual_step)) subject.variant = variant;
    subject.state = "after edit " + std::to_string(last->edit.edit.id) + " " + last->edit.operation;
    subject.scene = session.scene_after(last->edit.edit.id, progress);
}

GivenArguments given_by(const Operation& operation, const SubjectOptions& options) {
    std::vector<std::string> texts = options.arguments;
    if (!options.filter.empty()) {
        if (!searches_filter(operation.search))
            throw UsageError("--filter: " + operation.name + " has no filters");
        texts.push_back(operation.search.filter_parameter + "=" + options.filter);
    }
    return arguments_from_texts(operation, texts);
}

}  // namespace

SearchSubject search_subject(const SubjectOptions& options, const Progress& progress) {
    SearchSubject subject;
    subject.name = std::filesystem::path(options.source).filename().string();
    const Operation& operation = find_operation(
        options.operation.empty() ? searched_operations().front() : options.operation);
    subject.operation = &operation;
    if (!searches_filter(operation.search)) static_cast<void>(usual_score_of(operation));
    const GivenArguments given = given_by(operation, options);
    subject.given = given;
    subject.arguments = checked_arguments(given);
    if (options.source.ends_with(".vbench") || is_project_file(options.source))
        take_project(options, subject, progress);
    else
        subject.scene.surface =
            read_foreign_surface(options.source, options.units, progress.part(0.0, 0.1));
    static_cast<void>(surface_of(subject.scene));
    if (searches_filter(operation.search))
        subject.smoothing =
            operation.search.smoothing(subject.scene, subject.given, subject.arguments);
    return subject;
}

std::string change_text(const SearchSubject& subject) {
    const std::string& filter = subject.operation->search.filter_parameter;
    return subject.smoothing ? filter + " " + subject.arguments.text(filter)
                             : subject.operation->name;
}

ScoreForm usual_score(const SearchSubject& subject) {
    return subject.smoothing ? ScoreForm::Default : usual_score_of(*subject.operation);
}

SearchSpace space_for(const SearchSubject& subject, const ChosenEngine& chosen,
                      bool all_parameters) {
    SearchSpace space =
        subject.smoothing ? smoothing_space_for(*subject.smoothing, *chosen.engine, all_parameters)
                          : processing_space(*subject.operation, surface_of(subject.scene),
                                             subject.given, all_parameters);
    if (all_parameters) return space;
    for (SearchParameter& parameter : space.parameters)
        if (subject.given.has(parameter.name))
            parameter.values = {subject.given.real(parameter.name)};
    return space;
}

ChosenEngine engine_for(const SearchSubject& subject, bool planes) {
    if (!subject.smoothing) return {};
    return smoothing_engine(*subject.smoothing, planes);
}

ParameterSearch search_for(const SearchSubject& subject, const ChosenEngine& chosen,
                           const SearchSpace& space, ScoreSettings settings) {
    if (subject.smoothing) return {chosen.engine, space, settings};
    return {processing_table(*subject.operation, subject.scene, subject.arguments, space), space,
            settings};
}

ParameterSet given_set(const SearchSubject& subject, const SearchSpace& space,
                       const Progress& progress) {
    if (subject.smoothing) return smoothing_set(*subject.smoothing, space);
    return processing_set(*subject.operation, subject.scene, subject.arguments, space, progress);
}

Arguments arguments_of(const SearchSubject& subject, const SearchSpace& space,
                       const ParameterSet& set) {
    Arguments arguments = subject.arguments;
    set_values(arguments, *subject.operation, space, set);
    if (!subject.smoothing) return arguments;
    bool open = false;
    for (const std::string& name : subject.smoothing->followers) {
        if (value_of(space, set, name)) continue;
        arguments.remove(name);
        open = true;
    }
    if (open) subject.smoothing->decide(arguments);
    return arguments;
}

Arguments typed_arguments(const SearchSubject& subject, const SearchSpace& space,
                          const ParameterSet& set) {
    Arguments arguments = subject.given;
    if (const std::string& filter = subject.operation->search.filter_parameter; !filter.empty())
        arguments.set(filter, subject.arguments.text(filter));
    set_values(arguments, *subject.operation, space, set);
    return arguments;
}

Surface changed_with(const SearchSubject& subject, const SearchSpace& space,
                     const ParameterSet& set, const Progress& progress) {
    const Surface& surface = surface_of(subject.scene);
    if (subject.smoothing) return smoothed_with(*subject.smoothing, surface, space, set, progress);
    return processed_with(*subject.operation, subject.scene, subject.arguments, space, set,
                          progress);
}

}  // namespace vesselbench
