#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/review/cohort.h"

namespace vesselbench {

namespace {

std::string alpha_text(const Agreement& found) {
    if (found.units < kFewestUnits) return "too few";
    return found.alpha ? formatted(*found.alpha, "%.3f") : "all alike";
}

std::string interval_text(const Agreement& found) {
    if (!found.lower || !found.upper) return "-";
    return formatted(*found.lower, "%.3f") + " to " + formatted(*found.upper, "%.3f");
}

std::vector<std::string> row_of(const std::string& name, const EditAgreement& on) {
    const Agreement& found = on.agreement;
    return {name,
            std::to_string(found.units),
            std::to_string(found.values),
            std::to_string(on.unsure),
            found.share ? formatted(100.0 * *found.share, "%.1f %%") : "-",
            alpha_text(found),
            interval_text(found)};
}

void print_cohort(const CohortAgreement& cohort) {
    const std::vector<std::string> names(cohort.reviewers.begin(), cohort.reviewers.end());
    std::cout << counted(cohort.projects, "project") << ", " << counted(names.size(), "reviewer")
              << (names.empty() ? "" : ": " + printable(joined(names))) << "\n\n";
    if (cohort.all.agreement.units == 0) {
        std::cout << "no edit has decisions of two reviewers\n";
        return;
    }
    std::vector<std::vector<std::string>> rows = {
        {"operation", "edits", "values", "unsure", "agreement", "alpha", "95 % interval"}};
    for (const auto& [operation, on] : cohort.operations) rows.push_back(row_of(operation, on));
    rows.push_back(row_of("all", cohort.all));
    std::cout << as_columns(rows);
}

}  // namespace

bool summarize_reviews(const ReviewArguments& arguments, const Progress& progress) {
    const CohortAgreement cohort =
        cohort_agreement({arguments.projects.begin(), arguments.projects.end()}, progress);
    if (arguments.json)
        std::cout << text_from_json(cohort_json(cohort), 2) << "\n";
    else
        print_cohort(cohort);
    for (const UnreadProject& project : cohort.unread)
        complain(project.project + " is not counted: " + project.reason);
    return cohort.unread.empty();
}

}  // namespace vesselbench
