#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/progress.h"
#include "workbench/review/agreement.h"

namespace vesselbench {

/// How far reviewers agree on edits. A unit is an edit with one content (edit_hash()); its values
/// are accept and reject, of each reviewer the newest.
struct EditAgreement {
    Agreement agreement;
    std::size_t unsure = 0;  ///< newest verdicts that are no decision, and no values
};

struct UnreadProject {
    std::string project, reason;
};

/// What reviewers said in several projects. Reviewers are told apart by name, across projects.
struct CohortAgreement {
    std::size_t projects = 0;           ///< that were read
    std::vector<UnreadProject> unread;  ///< missing or damaged: nothing of them counts
    std::set<std::string> reviewers;    ///< who gave a verdict
    std::map<std::string, EditAgreement> operations;  ///< of every edit with a verdict
    EditAgreement all;                                ///< over all operations
};

/// Reads the verdicts of projects, beside whoever writes them. Those of edits that were changed
/// afterwards count, too: for the content that they were given on. Copies of a project, and files
/// that are given twice, count once.
[[nodiscard]] CohortAgreement cohort_agreement(const std::vector<std::filesystem::path>& projects,
                                               const Progress& progress = {});

/// {"projects", "unread", "reviewers", "operations", "all"}; an agreement is {"edits", "values",
/// "unsure", "share", "alpha", "interval", "too_few"}, with null for what is not known.
[[nodiscard]] nlohmann::ordered_json cohort_json(const CohortAgreement& cohort);

}  // namespace vesselbench
