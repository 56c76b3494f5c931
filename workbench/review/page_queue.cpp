#include "workbench/review/page_queue.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/readable_name.h"
#include "workbench/review/known_operation.h"

namespace vesselbench {

namespace {

/// All scores are in tenths of a radius: a warning is as urgent as a change of the wall by a tenth
/// or, with a place, an eighth of the radius; a decision without a doubt can wait.
constexpr double kPerRadius = 10.0;
constexpr double kStale = 100.0, kFurtherStale = 1.4;
constexpr double kWarning = 1.0, kPlacedWarning = 1.25, kDecision = 0.3;
constexpr double kMostShare = 5.0;  ///< of a radius: larger changes are as urgent
/// A person chose the place of a change, or overruled what the program measured: that weighs more
/// than a change of the same size that an operation makes by itself.
constexpr double kByHand = 2.0;
/// A change smaller than this share of the radius is not listed by itself.
constexpr double kLeastShare = 0.05;
/// The largest of many deviations of one kind is about so many times their root mean square.
constexpr double kUsualPeak = 3.0;
/// What an operation does all over the wall is what it is for.
constexpr double kSpreadWeight = 0.5;

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

/// The first one is the cause of others behind it as often as not.
void add_stale(const LogEntry& entry, std::vector<QueueItem>& queue) {
    if (entry.status != EditStatus::Stale) return;
    const bool further = std::ranges::count(queue, "stale", &QueueItem::kind) > 0;
    queue.push_back(item_of("stale", entry, further ? kFurtherStale : kStale, "No longer applies",
                            "It no longer applies and was skipped: " + entry.reason));
}

/// How much a change of the wall is out of the ordinary: what stands out of what the operation does
/// all over the wall, in radii; that in turn counts by kSpreadWeight.
double unusual(const WallChange& wall, double radius) {
    const double spread = std::min(kUsualPeak * wall.usual, wall.largest);
    return (wall.largest - spread + kSpreadWeight * spread) / radius;
}

/// Where it works was chosen by a person, not found by the operation.
bool is_placed_by_hand(const LogEntry& entry, const Operation* operation) {
    using enum Meaning;
    return operation != nullptr &&
           std::ranges::any_of(operation->parameters, [&](const Parameter& parameter) {
               const Meaning meaning = parameter.meaning;
               return entry.edit.given.has(parameter.name) &&
                      (meaning == Dabs || meaning == Place || meaning == Branch);
           });
}

void add_deviation(const LogEntry& entry, const Operation* operation, const PageModels& models,
                   std::vector<QueueItem>& queue) {
    const auto found = models.edits.find(entry.edit.edit.id);
    if (found == models.edits.end() || !found->second.before || !found->second.wall) return;
    const WallChange& wall = *found->second.wall;
    // without an opposite wall, as a sheet has none, the size of what changed is all there is
    const std::optional<Bounds>& changed = found->second.changed;
    const double radius = wall.radius ? *wall.radius : changed ? changed->diagonal() / 2 : 0.0;
    if (radius <= 0.0 || wall.largest < kLeastShare * radius) return;
    const std::string by =
        "by up to " + formatted(wall.largest, "%.3g mm") + (wall.inward ? " inwards" : " outwards");
    std::string why = "The wall moved " + by;
    if (wall.radius) why += ", where the vessel's radius is " + formatted(radius, "%.3g mm");
    const double by_hand = is_placed_by_hand(entry, operation) ? kByHand : 1.0;
    QueueItem item = item_of("deviation", entry,
                             kPerRadius * by_hand * std::min(unusual(wall, radius), kMostShare),
                             "Moved " + by, why);
    item.place = wall.place;
    item.radius = wall.radius;
    queue.push_back(std::move(item));
}

/// All of an edit are one item, as urgent as the worst of them.
void add_choices(const LogEntry& entry, const PageModels& models, std::vector<QueueItem>& queue) {
    const auto found = models.edits.find(entry.edit.edit.id);
    if (found == models.edits.end() || found->second.others.empty()) return;
    const std::vector<OtherChoice>& others = found->second.others;
    const auto worst = std::ranges::max_element(others, {}, &OtherChoice::doubt);
    std::vector<std::string> texts;
    for (const OtherChoice& other : others) texts.push_back(readable_sentence(other.what));
    QueueItem item = item_of("choice", entry, kPerRadius * kByHand * worst->doubt,
                             "Decided otherwise by hand", joined(texts, "; "));
    item.place = worst->place;
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

/// What was decided, as a reader would say it: those of one meaning are one thing.
std::string decided_words(const Parameter& parameter) {
    if (parameter.meaning == Meaning::Planes) return "openings";
    if (parameter.meaning == Meaning::Roles) return "inlet";
    return with_blanks(parameter.name);
}

void add_decisions(const LogEntry& entry, const Operation* operation,
                   std::vector<QueueItem>& queue) {
    if (operation == nullptr || !entry.result) return;
    std::vector<std::string> words;
    for (const Parameter& parameter : operation->parameters) {
        if (parameter.use != Use::Decision || !entry.result->resolved.has(parameter.name) ||
            entry.edit.given.has(parameter.name))
            continue;
        const std::string decided = decided_words(parameter);
        if (std::ranges::count(words, decided) == 0) words.push_back(decided);
    }
    if (words.empty()) return;
    const std::string what = enumerated(words);
    queue.push_back(item_of("decision", entry, kDecision,
                            readable_sentence(what) + " chosen by the program",
                            "The program chose " + what + " by itself"));
}

}  // namespace

std::vector<QueueItem> review_queue(const std::vector<LogEntry>& log, const PageModels& models,
                                    const OperationLookup& find) {
    std::vector<QueueItem> queue;
    for (const LogEntry& entry : log) {
        const Operation* operation = known_operation(find, entry.edit.operation);
        add_stale(entry, queue);
        add_deviation(entry, operation, models, queue);
        add_choices(entry, models, queue);
        add_warnings(entry, queue);
        add_decisions(entry, operation, queue);
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
        if (item.folded) row["folded"] = true;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace vesselbench
