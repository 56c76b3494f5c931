#include "workbench/prepare/extraction_entry.h"

#include <algorithm>
#include <string>

#include "geometry/image/threshold.h"
#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/label_choice.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

constexpr const char* kMethod = "method";

/// A mask that is no label map: it was bounded by a value.
bool bounded_mask(const std::vector<LogEntry>& log) {
    bool bounded = false;
    for (const LogEntry& entry : log) {
        if (find_operation(entry.edit.operation).recipe.loads != InputKind::Image) continue;
        bounded = entry.result && entry.result->resolved.has("mask_iso");
    }
    return bounded;
}

}  // namespace

bool takes_unchosen_labels(const Arguments& given, const Scene& scene) {
    if (!scene.image || given.has("labels") || !scene.segmentation.vessel.empty()) return false;
    const std::string method = given.optional_text(kMethod).value_or("auto");
    const bool level = given.has("threshold") || given.has("iso");
    if (method == "threshold" || (level && !scene.mask)) return false;
    const Image& labels = label_image(scene);
    if (!scene.mask && method == "auto" && judge(labels).kind != ImageKind::Labels) return false;
    return labels_of(labels).size() > 1;
}

RecipeEntry extraction_entry(const RecipeEntry& entry, Session& session) {
    const std::vector<LogEntry> log = session.log();
    if (!entry.given.operation().recipe.makes_source || log.empty()) return entry;
    const Scene scene = session.scene_after(log.back().edit.edit.id);
    if (takes_unchosen_labels(entry.given, scene)) {
        const Image& labels = label_image(scene);
        throw DiagnosedUsage(label_unchosen(scene.segmentation.segments, label_sizes(labels)));
    }
    RecipeEntry own = entry;
    if (own.if_drawn && bounded_mask(log)) own.given.set(kMethod, std::string("auto"));
    return own;
}

}  // namespace vesselbench
