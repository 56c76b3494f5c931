#include "workbench/review/cohort.h"

#include <optional>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/review/entered_verdicts.h"
#include "workbench/review/reviewer_name.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

struct Said {
    std::string time;
    Verdict verdict = Verdict::None;
    std::string reviewer;  ///< as the name is written
};

/// An edit with one content, and the newest verdict of each reviewer on it.
struct JudgedEdit {
    std::string operation;
    std::map<std::string, Said> by_reviewer;  ///< by compared_name()
};

/// The project's id, the edit, and edit_hash().
using EditKey = std::tuple<std::string, EditRef, std::string>;
using JudgedEdits = std::map<EditKey, JudgedEdit>;

void add(JudgedEdits& edits, const EditKey& key, Said said) {
    const auto [found, is_new] =
        edits[key].by_reviewer.try_emplace(compared_name(said.reviewer), said);
    if (!is_new && found->second.time <= said.time) found->second = std::move(said);
}

/// \throw InvalidInput, IoError if the project cannot be read
JudgedEdits judged_in(const std::filesystem::path& path) {
    const ProjectFile project = ProjectFile::open_to_read(path, "its verdicts are counted");
    const std::string id = project.id();
    JudgedEdits edits;
    for (const EnteredVerdicts& entered : entered_verdicts(project))
        for (const EditVerdict& verdict : entered.verdicts.edits)
            if (verdict.verdict != Verdict::None)
                add(edits, {id, verdict.edit, verdict.hash},
                    {verdict.time, verdict.verdict, entered.verdicts.reviewer});
    std::set<EditRef> refs;
    for (const auto& [key, edit] : edits) refs.insert(std::get<EditRef>(key));
    const auto records = project.edits({refs.begin(), refs.end()});
    for (auto& [key, edit] : edits) edit.operation = records.at(std::get<EditRef>(key)).operation;
    return edits;
}

void merge(JudgedEdits read, JudgedEdits& all) {
    for (auto& [key, edit] : read) {
        all[key].operation = edit.operation;
        for (auto& [reviewer, said] : edit.by_reviewer) add(all, key, std::move(said));
    }
}

EditAgreement agreement_on(const std::vector<const JudgedEdit*>& edits) {
    EditAgreement made;
    std::vector<RatedUnit> units;
    for (const JudgedEdit* edit : edits) {
        RatedUnit& unit = units.emplace_back();
        for (const auto& [reviewer, said] : edit->by_reviewer)
            if (said.verdict == Verdict::Unsure)
                ++made.unsure;
            else
                unit.push_back(to_string(said.verdict));
    }
    made.agreement = agreement_of(units);
    return made;
}

Json number_json(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

Json agreement_json(const EditAgreement& on) {
    const Agreement& found = on.agreement;
    Json interval;
    if (found.lower && found.upper) interval = {*found.lower, *found.upper};
    return {{"edits", found.units},
            {"values", found.values},
            {"unsure", on.unsure},
            {"share", number_json(found.share)},
            {"alpha", number_json(found.alpha)},
            {"interval", interval},
            {"too_few", found.units < kFewestUnits}};
}

}  // namespace

CohortAgreement cohort_agreement(const std::vector<std::filesystem::path>& projects,
                                 const Progress& progress) {
    CohortAgreement made;
    JudgedEdits judged;
    for (std::size_t i = 0; i < projects.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(projects.size()),
                        "reading verdicts");
        try {
            merge(judged_in(projects[i]), judged);
            ++made.projects;
        } catch (const InvalidInput& error) {
            made.unread.push_back({projects[i].string(), error.what()});
        } catch (const IoError& error) {
            made.unread.push_back({projects[i].string(), error.what()});
        }
    }
    std::map<std::string, std::vector<const JudgedEdit*>> by_operation;
    std::vector<const JudgedEdit*> all;
    std::map<std::string, std::string> names;  // of one who is written in several ways, one
    for (const auto& [key, edit] : judged) {
        by_operation[edit.operation].push_back(&edit);
        all.push_back(&edit);
        for (const auto& [reviewer, said] : edit.by_reviewer)
            names.try_emplace(reviewer, said.reviewer);
    }
    for (const auto& [compared, name] : names) made.reviewers.insert(name);
    for (const auto& [operation, edits] : by_operation)
        made.operations[operation] = agreement_on(edits);
    made.all = agreement_on(all);
    return made;
}

Json cohort_json(const CohortAgreement& cohort) {
    Json unread = Json::array(), operations = Json::array();
    for (const UnreadProject& project : cohort.unread)
        unread.push_back({{"project", project.project}, {"reason", project.reason}});
    for (const auto& [operation, on] : cohort.operations) {
        operations.push_back({{"operation", operation}});
        operations.back().update(agreement_json(on));
    }
    return {{"projects", cohort.projects},
            {"unread", unread},
            {"reviewers", cohort.reviewers},
            {"operations", operations},
            {"all", agreement_json(cohort.all)}};
}

}  // namespace vesselbench
