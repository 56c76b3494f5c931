#include "workbench/review/page_queue.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/readable_name.h"

namespace vesselbench {

namespace {

/// Scores by kind: a stale edit leaves a model unfinished; a change of a whole radius is as urgent
/// as a warning; a decision without a doubt can wait.
constexpr double kStale = 100.0, kWarning = 10.0, kPlacedWarning = 12.0, kDecision = 1.0;
constexpr double kPerRadius = 10.0;
constexpr double kMostShare = 5.0;  ///< of a radius: larger changes are as urgent
/// A change smaller than this share of the radius is not listed by itself.
constexpr double kLeastShare = 0.05;
/// Of a change that the operation is for: cuts and extensions of ends, cut branches. Their size
/// says little, their place is still worth a look.
constexpr double kMeantShare = 0.3;

const Operation* known(const OperationLookup& find, const std::string& name) {
    try {
        return &find(name);
    } catch (const UsageError&) {  // of another version
        return nullptr;
    }
}

/// Edits of these steps add or remove whole parts by their nature.
bool is_meant_to_move_much(const LogEntry& entry) {
    const Step step = entry.edit.place.step;
    return step == Step::Openings || step == Step::Product || step == Step::Source;
}

QueueItem item_of(const char* kind, const LogEntry& entry, double score, std::string title,
                  std::string why) {
    return {.kind = kind,
            .edit = entry.edit.edit.id,
            .title = std::move(title),
            .why = std::move(why),
            .score = score,
            .place = {},
            .radius = {}};
}

void add_stale(const LogEntry& entry, std::vector<QueueItem>& queue) {
    if (entry.status != EditStatus::Stale) return;
    queue.push_back(item_of("stale", entry, kStale, "No longer applies",
                            "It no longer applies and was skipped: " + entry.reason));
}

void add_deviation(const LogEntry& entry, const PageModels& models, std::vector<QueueItem>& queue) {
    const auto found = models.edits.find(entry.edit.edit.id);
    if (found == models.edits.end() || !found->second.before || !found->second.place) return;
    const PageEditModel& model = found->second;
    const double radius = model.radius.value_or(0.0);
    const double share = radius > 0.0 ? model.largest / radius : 1.0;
    if (share < kLeastShare) return;
    const double meant = is_meant_to_move_much(entry) ? kMeantShare : 1.0;
    std::string why = "The surface differs by up to " + formatted(model.largest, "%.3g mm");
    if (radius > 0.0) why += ", where the vessel's radius is " + formatted(radius, "%.3g mm");
    QueueItem item = item_of("deviation", entry, kPerRadius * meant * std::min(share, kMostShare),
                             "Differs by up to " + formatted(model.largest, "%.3g mm"), why);
    item.place = model.place;
    item.radius = model.radius;
    queue.push_back(std::move(item));
}

/// All of an edit are one item: they are read together.
void add_warnings(const LogEntry& entry, std::vector<QueueItem>& queue) {
    if (!entry.result || entry.result->warnings.empty()) return;
    std::vector<std::string> texts;
    std::optional<Vec3> place;
    for (const Diagnostic& warning : entry.result->warnings) {
        texts.push_back(readable_sentence(worded(warning, {.window = true})));
        if (!place) place = warning.place;
    }
    const std::string title = texts.size() == 1 ? texts.front() : counted(texts.size(), "warning");
    QueueItem item =
        item_of("warning", entry, place ? kPlacedWarning : kWarning, title, joined(texts, "; "));
    item.place = place;
    queue.push_back(std::move(item));
}

void add_decisions(const LogEntry& entry, const Operation* operation,
                   std::vector<QueueItem>& queue) {
    if (operation == nullptr || !entry.result) return;
    std::vector<std::string> names;
    for (const Parameter& parameter : operation->parameters)
        if (parameter.use == Use::Decision && entry.result->resolved.has(parameter.name) &&
            !entry.edit.given.has(parameter.name))
            names.push_back(readable(parameter.name));
    if (names.empty()) return;
    queue.push_back(item_of("decision", entry, kDecision, joined(names),
                            "The program decided by itself: " + joined(names)));
}

}  // namespace

std::vector<QueueItem> review_queue(const std::vector<LogEntry>& log, const PageModels& models,
                                    const OperationLookup& find) {
    std::vector<QueueItem> queue;
    for (const LogEntry& entry : log) {
        add_stale(entry, queue);
        add_deviation(entry, models, queue);
        add_warnings(entry, queue);
        add_decisions(entry, known(find, entry.edit.operation), queue);
    }
    std::ranges::stable_sort(queue, std::ranges::greater{}, &QueueItem::score);
    return queue;
}

nlohmann::ordered_json queue_json(const std::vector<QueueItem>& queue) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const QueueItem& item : queue) {
        nlohmann::ordered_json row = {{"kind", item.kind},
                                      {"edit", item.edit},
                                      {"title", item.title},
                                      {"why", item.why},
                                      {"score", item.score}};
        if (item.place) row["place"] = {item.place->x(), item.place->y(), item.place->z()};
        if (item.radius) row["radius"] = *item.radius;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace vesselbench
