#include "workbench/prepare/acceptance_gate.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/result_folder.h"
#include "workbench/review/record_gate.h"
#include "workbench/review/review_page.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPage = "review.html";
constexpr const char* kStored = "the stored acceptance";

/// A file of the page's name that is none is the user's.
bool is_review_page(const std::filesystem::path& file) {
    return std::filesystem::is_regular_file(file) &&
           file_content(file).find("vesselbench-review") != std::string::npos;
}

/// A build without npm has no page: a warning says so.
void write_page(Session& session, const std::string& purpose, const std::filesystem::path& folder,
                const Teller& tell, const Progress& progress) {
    try {
        const ReviewPage page =
            review_page(session, purpose, find_operation, PageImages::Contours, progress);
        if (!is_review_page(folder / kPage)) keep_earlier(folder / kPage, tell);
        PendingFiles files;
        (void)files.add_text(folder / kPage, page.html);
        files.commit();
        tell(std::string(kPage) +
             " is the page for reviewers; `review project.vbench --import verdicts.json` enters "
             "what they send back, then the same command with --resume writes the products");
    } catch (const DiagnosedFailure& failure) {
        for (const Diagnostic& diagnostic : failure.diagnostics()) tell.warn(diagnostic);
    }
}

}  // namespace

std::size_t kept_reviewers(const std::filesystem::path& project, const std::string& purpose,
                           std::size_t asked) {
    const std::string text = stored_text(project, StoredText::Acceptance);
    Json kept = text.empty() ? Json::object() : json_from_text(text, kStored);
    JsonFields fields(kept, kStored);
    const std::size_t earlier = fields.optional<std::size_t>(purpose.c_str()).value_or(0);
    if (asked <= earlier) return earlier;
    kept[purpose] = asked;
    store_text(project, StoredText::Acceptance, kept.dump());
    return asked;
}

void require_acceptance(const Session& session, const std::filesystem::path& project,
                        const std::string& purpose, std::size_t asked, const Review& review) {
    const std::size_t reviewers = std::max(asked, kept_reviewers(project, purpose, 0));
    require_sound_record(session, reviewers);
    if (reviewers == 0) return;
    require_accepted(review, reviewers);
    if (const std::string& reason = session.read_only_reason(); !reason.empty())
        throw DiagnosedFailure({.code = "export-not-recorded", .words = {{"reason", reason}}});
}

void pass_gate(Session& session, const std::string& purpose, std::size_t reviewers,
               const std::filesystem::path& folder, const Teller& tell, const Progress& progress) {
    require_sound_record(session, reviewers);
    if (reviewers == 0) return;
    const Review review = review_of(session, purpose);
    if (!missing_acceptance(review, reviewers).empty())
        write_page(session, purpose, folder, tell, progress);
    require_accepted(review, reviewers);
}

}  // namespace vesselbench
