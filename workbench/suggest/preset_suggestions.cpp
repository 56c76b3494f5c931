#include "workbench/suggest/preset_suggestions.h"

#include <array>
#include <utility>

#include "workbench/suggest/search_subject.h"
#include "workbench/suggest/suggestion_search.h"

namespace vesselbench {

namespace {

constexpr std::array kFilterValues = {"iterations", "lambda", "mu", "alpha", "beta"};

SearchSubject subject_of(const Operation& operation, const Scene& scene, Arguments given) {
    SearchSubject subject{
        .operation = &operation, .scene = scene, .given = without_filter_values(std::move(given))};
    subject.arguments = checked_arguments(operation, subject.given);
    subject.smoothing = operation.search.smoothing(scene, subject.given, subject.arguments);
    return subject;
}

}  // namespace

std::span<const char* const> filter_values() {
    return kFilterValues;
}

Arguments without_filter_values(Arguments given) {
    for (const char* name : kFilterValues) given.remove(name);
    return given;
}

void suggest_presets(const Operation& operation, const Scene& scene, const Arguments& given,
                     const std::function<void(PresetSuggestion)>& receive,
                     const Progress& progress) {
    const SearchSubject subject = subject_of(operation, scene, given);
    progress.check_cancelled();
    SuggestionSearch search(subject, usual_score(subject), SearchWay::Automatic);
    for (const double tau : kPresetTaus) {
        const Suggestion found = search.suggest(tau, progress);
        const QualityMeasures& original = search.original();
        receive({.tau = tau,
                 .arguments = typed_arguments(subject, search.space(), found.values),
                 .surface = search.changed(found.values, progress),
                 .does_nothing = does_nothing(search.space(), found.values),
                 .error = found.measures.error,
                 .curvature_percent = curvature_percent(original, found.measures),
                 .volume_change_percent = volume_change_percent(original, found.measures)});
    }
}

}  // namespace vesselbench
