#include "workbench/review/statement.h"

#include <algorithm>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/measure_json.h"
#include "workbench/project/project.h"
#include "workbench/report/log_json.h"
#include "workbench/review/known_operation.h"
#include "workbench/review/reporting_items.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// The files that an edit has read, and what its report says of their resolution.
void add_sources(const Session& session, const LogEntry& entry, Json& sources) {
    for (const SourceFile& file : session.project().sources(entry.edit.edit)) {
        Json source = {{"edit", entry.edit.edit.id},
                       {"as", file.parameter},
                       {"file", file.name},
                       {"sha256", file.hash}};
        const Json report = entry.result ? reported(*entry.result) : Json::object();
        for (const char* key : {"format", "size_voxels", "spacing_mm", "units", "triangles"})
            if (report.contains(key)) source[key] = report[key];
        sources.push_back(std::move(source));
    }
}

Json edit_json(const LogEntry& entry, const Operation* operation) {
    const EditRecord& edit = entry.edit;
    Json json = {
        {"edit", edit.edit.id},
        {"revision", edit.edit.revision},
        {"step", to_string(edit.place.step)},
        {"variant", edit.place.variant},
        {"operation", edit.operation},
        {"arguments", operation != nullptr ? argument_summary(*operation, edit.given) : "?"},
        {"author", edit.author},
        {"time", edit.time},
        {"note", edit.note},
        {"status", to_string(entry.status)},
        {"effect", entry.result ? effect_text(*entry.result) : entry.reason}};
    if (entry.result) json["accuracy"] = change_json(entry.result->change);
    return json;
}

Json reviewers_json(const Review& review) {
    struct Counts {
        std::string role;
        std::map<std::string, int> verdicts;
        std::set<std::string> signatures;
    };

    std::map<std::string, Counts> reviewers;
    const auto count = [&](const GivenVerdict& given) {
        Counts& counts = reviewers[given.reviewer];
        counts.role = given.role;
        counts.signatures.insert(signature_words(given.signature));
        ++counts.verdicts[given.outdated ? "outdated" : to_string(given.verdict)];
    };
    for (const ReviewedEdit& edit : review.edits) std::ranges::for_each(edit.verdicts, count);
    std::ranges::for_each(review.overall, count);
    Json list = Json::array();
    for (const auto& [name, counts] : reviewers)
        list.push_back({{"name", name},
                        {"role", counts.role},
                        {"verdicts", counts.verdicts},
                        {"signatures", counts.signatures}});
    return list;
}

}  // namespace

Json statement_of(const Session& session, const Review& review, std::span<const ChainEntry> entries,
                  const OperationLookup& find) {
    std::set<std::string> versions, operators;
    Json sources = Json::array(), segmentation = Json::array(), edits = Json::array();
    for (const LogEntry& entry : session.log()) {
        const Operation* operation = known_operation(find, entry.edit.operation);
        operators.insert(entry.edit.author);
        if (entry.result) versions.insert(entry.result->program_version);
        add_sources(session, entry, sources);
        edits.push_back(edit_json(entry, operation));
        if (operation == nullptr || !operation->recipe.makes_source) continue;
        segmentation.push_back(edits.back());
        segmentation.back()["loaded"] = operation->recipe.loads.has_value();
    }
    Json statement = {{"program_versions", versions},
                      {"variants", session.snapshot()->history->variants()},
                      {"sources", sources},
                      {"segmentation", segmentation},
                      {"edits", edits},
                      {"operators", operators},
                      {"reviewers", reviewers_json(review)},
                      {"review", review_words(review)},
                      {"exports", exports_json(entries)}};
    statement["items"] = reporting_items(statement);
    return statement;
}

}  // namespace vesselbench
