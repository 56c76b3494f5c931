#include "workbench/findings/treatment.h"

#include <algorithm>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/readable_name.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/question.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

GivenArguments given_by(const Remedy& treatment) {
    const Operation& operation = find_operation(treatment.operation);
    std::vector<std::string> texts;
    for (const auto& [name, value] : treatment.arguments) texts.push_back(name + "=" + value);
    return arguments_from_texts(operation, texts);
}

}  // namespace

Step treatment_step(const Operation& operation, const std::vector<LogEntry>& log) {
    const Step last = log.empty() ? Step::Source : log.back().edit.place.step;
    if (operation.usual_step >= last || operation.usual_step == Step::Branches)
        return operation.usual_step;
    std::vector<Step> allowed = operation.allowed;
    std::ranges::sort(allowed);
    const auto behind = std::ranges::lower_bound(allowed, last);
    return behind != allowed.end() ? *behind : allowed.back();
}

std::string treatment_note(const Finding& finding) {
    const Reading* artefact = artefact_reading(finding);
    if (artefact == nullptr) return title_of_kind(finding.kind) + ": " + worded(finding.evidence);
    return readable_sentence(artefact->name) + " (of: " + odds_words(finding) +
           "): " + worded(finding.evidence);
}

std::string refusal_of(Session& session, const Finding& finding, const std::string& variant,
                       const Progress& progress) {
    if (finding.treatment() == nullptr) return "";
    const Operation& operation = find_operation(finding.treatment()->operation);
    try {
        static_cast<void>(session.preview(
            operation.name, given_by(*finding.treatment()),
            {.step = treatment_step(operation, session.log(variant)), .variant = variant},
            progress));
    } catch (const AlgorithmFailure& failure) {
        return worded(diagnostics_of(failure).front());
    } catch (const InvalidInput& failure) {
        return worded(diagnostics_of(failure).front());
    }
    return "";
}

LogEntry treat(Session& session, const Finding& finding, const std::string& taken_as,
               const std::string& variant, const Progress& progress) {
    require_answer(finding, taken_as);
    const Remedy* treatment = finding.treatment();
    if (treatment == nullptr)
        throw DiagnosedFailure({.code = "finding-without-treatment",
                                .place = finding.place,
                                .words = {{"finding", finding.id()}}});
    const GivenArguments given = given_by(*treatment);
    return session.apply(given,
                         {.step = treatment_step(given.operation(), session.log(variant)),
                          .variant = variant,
                          .note = treatment_note(finding)},
                         progress);
}

}  // namespace vesselbench
