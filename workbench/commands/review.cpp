#include "workbench/review/review.h"

#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/table.h"
#include "workbench/project/project.h"
#include "workbench/review/finding_items.h"
#include "workbench/review/page_queue.h"
#include "workbench/review/retired_keys.h"
#include "workbench/review/review_json.h"
#include "workbench/review/review_page.h"
#include "workbench/review/signing_keys.h"
#include "workbench/review/verdict_import.h"
#include "workbench/session/edit_place.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string verdict_words(const GivenVerdict& given) {
    std::string text = given.reviewer;
    if (given.signature.state != SignatureState::None)
        text += " (" + signature_words(given.signature) + ")";
    text += ": " + to_string(given.verdict);
    if (given.outdated) text += " (outdated)";
    return text + (given.comment.empty() ? "" : ", \"" + given.comment + "\"");
}

std::string verdict_list(const std::vector<GivenVerdict>& verdicts) {
    std::vector<std::string> texts;
    for (const GivenVerdict& given : verdicts) texts.push_back(verdict_words(given));
    return joined(texts, "; ");
}

/// "SHA256:...: A. Kern, kern@clinic.example, 2 files"
std::string key_words(const SigningKey& key) {
    std::vector<std::string> texts = key.reviewers;
    texts.insert(texts.end(), key.principals.begin(), key.principals.end());
    texts.push_back(counted(key.files, "file"));
    if (key.retired)
        texts.push_back("retired on " + key.retired->time + " by " + key.retired->author + ": " +
                        key.retired->reason);
    return key.fingerprint + ": " + joined(texts);
}

void print_review(const Review& review, const std::vector<SigningKey>& keys) {
    std::vector<std::vector<std::string>> rows = {{"edit", "step", "operation", "review", "by"}};
    for (const ReviewedEdit& edit : review.edits)
        rows.push_back({std::to_string(edit.edit.id) + "." + std::to_string(edit.edit.revision),
                        to_string(edit.place.step) +
                            (edit.place.variant.empty() ? "" : " (" + edit.place.variant + ")"),
                        edit.operation, to_string(edit.status) + (edit.pending ? ", pending" : ""),
                        verdict_list(edit.verdicts)});
    std::cout << as_columns(rows);
    if (!review.overall.empty())
        std::cout << printable("the whole: " + verdict_list(review.overall)) << "\n";
    for (const SigningKey& key : keys) std::cout << printable("key " + key_words(key)) << "\n";
    std::cout << review_words(review) << "\n";
}

PageImages images_of(const std::string& word) {
    if (word == "off") return PageImages::None;
    return word == "slices" ? PageImages::Slices : PageImages::Contours;
}

/// Written beside its place and renamed, as all results are. \return the page's queue
Json write_page(Session& session, const ReviewArguments& arguments, const Progress& progress) {
    if (std::filesystem::exists(arguments.page) && session.is_source(arguments.page))
        throw UsageError(bare_name(arguments.page) + " is a file that the case was made from");
    const std::string variant = variant_meant(arguments.variant, *session.snapshot()->history);
    const ReviewPage page =
        review_page(session, variant, find_operation, images_of(arguments.images), progress);
    PendingFiles files;
    (void)files.add_text(arguments.page, page.html);
    files.commit();
    remark(bare_name(arguments.page) + ": a page for reviewers, " + size_text(page.html.size()));
    return page.queue;
}

/// What a reviewer should look at first, as the page lists it.
Json queue_of(Session& session, const std::string& variant_asked, const Progress& progress) {
    const std::string variant = variant_meant(variant_asked, *session.snapshot()->history);
    const std::vector<LogEntry> log = session.log(variant);
    std::vector<QueueItem> queue = review_queue(
        log, page_models(session, log, find_operation, kQueueOnly, progress), find_operation);
    const std::vector<QueueItem> findings = finding_items(session, log, progress);
    queue.insert(queue.end(), findings.begin(), findings.end());
    return queue_json(queue);
}

}  // namespace

void review_project(const ReviewArguments& arguments, const Progress& progress) {
    if (arguments.projects.size() != 1)
        throw UsageError("one project is reviewed at a time; several are given to --summary only");
    Session session = Session::open(arguments.projects.front(), {.find = find_operation});
    Json imported = Json::array();
    for (const std::string& file : arguments.imported) {
        const ImportedVerdicts done = import_verdicts(session, file, arguments.signers, progress);
        remark(bare_name(file) + ": " + imported_words(done));
        imported.push_back({{"file", bare_name(file)},
                            {"reviewer", done.verdicts.reviewer},
                            {"verdicts", done.verdicts.said()},
                            {"outdated", done.outdated},
                            {"known", done.known},
                            {"signature", signature_json(done.signature)}});
    }
    if (!arguments.retired_key.empty())
        retire_key(session, arguments.retired_key, arguments.reason);
    Json queue;
    if (!arguments.page.empty()) queue = write_page(session, arguments, progress);
    const std::vector<EnteredVerdicts> entered =
        entered_verdicts(session.project(), arguments.signers, progress);
    const Review review = review_of(session.project(), session.log(), entered);
    const std::vector<SigningKey> keys = signing_keys(entered, retired_keys(session.project()));
    if (!arguments.json) return print_review(review, keys);
    Json json = {{"project", session.project().name()},
                 {"id", session.project().id()},
                 {"head", session.project().record_head()},
                 {"imported", imported}};
    json.update(review_json(review));
    json["keys"] = keys_json(keys);
    json["queue"] = arguments.page.empty() ? queue_of(session, arguments.variant, progress) : queue;
    std::cout << text_from_json(json, 2) << "\n";
}

}  // namespace vesselbench
