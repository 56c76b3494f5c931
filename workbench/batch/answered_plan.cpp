#include "workbench/batch/answered_plan.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// A place as far from an end is another one's [diameters].
constexpr double kReach = 0.5;

std::string shown(const std::string& name) {
    return "the case '" + shortened(printable(name)) + "'";
}

void refuse_unknown_cases(const Answers& given, const std::vector<BatchCase>& cases) {
    for (const auto& [name, of_case] : given)
        if (std::ranges::count(cases, name, &BatchCase::name) == 0)
            throw InvalidInput("--answers: " + shown(name) + " is none of this batch");
}

bool is_end_of(const EndQuestion& question, const Vec3& place) {
    return std::ranges::any_of(question.ends, [&](const QuestionedEnd& end) {
        return (end.place - place).norm() <= kReach * end.diameter;
    });
}

/// Of a case without a question, `prepare` looks for the ends.
void refuse_unknown_ends(const std::string& name, const CaseAnswers& answers,
                         const BatchFolders& folders) {
    const std::optional<EndQuestion> question = read_end_question(folders.of(name));
    if (!question) return;
    for (const AnsweredEnd& end : answers.ends)
        if (!is_end_of(*question, end.place))
            throw InvalidInput("--answers: " + shown(name) + " was not asked about an end at " +
                               place_text(end.place) + "; " + kEndQuestion +
                               " in its folder lists the places of its ends");
}

Answers united(Answers answers, const Answers& earlier) {
    answers.insert(earlier.begin(), earlier.end());
    return answers;
}

/// \return true if some were for other files than the cases have
bool leave_out_outdated(Answers& given, const std::vector<PlannedCase>& cases,
                        const BatchTeller& tell) {
    bool any = false;
    for (const PlannedCase& one : cases) {
        if (!one.outdated || given.erase(one.what.name) == 0) continue;
        tell(one.what.name + ": its new answers are refused: its input has changed since it was " +
             "asked (SHA-256)");
        any = true;
    }
    return any;
}

}  // namespace

AnsweredPlan plan_with_answers(const std::vector<BatchCase>& cases, const BatchOptions& options,
                               const BatchTeller& tell) {
    const fs::path file = options.folders.out / kAnswers;
    const Answers kept = fs::exists(file) ? answers_in(file) : Answers{};
    Answers given = options.answers.empty() ? Answers{} : answers_in(options.answers);
    refuse_unknown_cases(given, cases);
    std::vector<PlannedCase> plans = planned(cases, options, united(given, kept));
    if (leave_out_outdated(given, plans, tell))
        plans = planned(cases, options, united(given, kept));
    for (const auto& [name, of_case] : given)
        if (const auto known = kept.find(name); known == kept.end() || known->second != of_case)
            refuse_unknown_ends(name, of_case, options.folders);
    for (const PlannedCase& one : plans)
        if (one.outdated)
            tell(one.what.name + ": its earlier answers are not used: its input has changed since");
    return {std::move(plans), united(std::move(given), kept)};
}

}  // namespace vesselbench
