#include "workbench/review/review_page.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "workbench/review/finding_items.h"
#include "workbench/review/page_file.h"
#include "workbench/review/page_manifest.h"
#include "workbench/review/review_page_bytes.h"

namespace vesselbench {

namespace {

/// Fraction of the progress for pending edits.
constexpr double kEditsShare = 0.5;

}  // namespace

ReviewPage review_page(Session& session, const std::string& variant, const OperationLookup& find,
                       PageImages images, const Progress& progress) {
    require_page(review_page_bytes());
    static_cast<void>(session.scene(variant, progress.part(0.0, kEditsShare)));
    const std::vector<LogEntry> log = session.log(variant);
    const PageModels models =
        page_models(session, log, find, {.images = images}, progress.part(kEditsShare, 0.9));
    std::map<std::string, std::string> blobs = models.geometry.blobs();
    blobs.insert(models.slices.begin(), models.slices.end());
    nlohmann::ordered_json manifest = page_manifest(session, variant, log, models, images, find);
    nlohmann::ordered_json findings =
        queue_json(finding_items(session, log, progress.part(0.9, 1.0)));
    for (nlohmann::ordered_json& item : findings) manifest["queue"].push_back(std::move(item));
    return {filled_page(review_page_bytes(), manifest, blobs), manifest["queue"]};
}

}  // namespace vesselbench
