#include "workbench/findings/dismissals.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"
#include "workbench/project/utc_time.h"
#include "workbench/session/login_name.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kSameSize = 1.5;

Json json_of(const std::vector<Dismissal>& dismissals) {
    Json json = Json::array();
    for (const Dismissal& dismissal : dismissals)
        json.push_back({{"kind", dismissal.kind},
                        {"place", point_json(dismissal.place)},
                        {"size", dismissal.size},
                        {"reason", dismissal.reason},
                        {"author", dismissal.author},
                        {"time", dismissal.time}});
    return json;
}

Dismissal dismissal_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const auto point = fields.required<std::array<double, 3>>("place");
    return {.kind = fields.required<std::string>("kind"),
            .place = {point[0], point[1], point[2]},
            .size = fields.required<double>("size"),
            .reason = fields.required<std::string>("reason"),
            .author = fields.required<std::string>("author"),
            .time = fields.required<std::string>("time")};
}

void require_reason(const std::string& reason) {
    const auto is_blank = [](unsigned char c) { return std::isspace(c) != 0; };
    if (std::ranges::all_of(reason, is_blank))
        throw UsageError("a finding is dismissed with a reason: give --reason WORDS");
    if (reason.size() > kLongestReason)
        throw UsageError("the reason is longer than " + std::to_string(kLongestReason) +
                         " bytes: shorten it");
    require_utf8(reason, "the reason");
}

struct Pair {
    double distance = 0.0;  ///< [mm]
    std::size_t finding = 0, dismissal = 0;
};

/// By finding, the dismissal that hides it: pairs are made from the nearest to the farthest.
std::vector<std::optional<std::size_t>> nearest_dismissals(std::span<const Finding> findings,
                                                           std::span<const Dismissal> dismissals) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < findings.size(); ++i)
        for (std::size_t k = 0; k < dismissals.size(); ++k)
            if (is_of(dismissals[k], findings[i]))
                pairs.push_back({(dismissals[k].place - findings[i].place).norm(), i, k});
    std::ranges::stable_sort(pairs, {}, &Pair::distance);
    std::vector<std::optional<std::size_t>> hidden_by(findings.size());
    std::vector<bool> used(dismissals.size());
    for (const Pair& pair : pairs) {
        if (hidden_by[pair.finding] || used[pair.dismissal]) continue;
        hidden_by[pair.finding] = pair.dismissal;
        used[pair.dismissal] = true;
    }
    return hidden_by;
}

/// \param said of the finding, in the record
void store(const std::filesystem::path& project, const std::vector<Dismissal>& dismissals,
           const StoredChange& said) {
    store_text(project, StoredText::Dismissals, text_from_json(json_of(dismissals)), said);
}

}  // namespace

std::string Dismissal::id() const {
    return Finding{.kind = kind, .place = place}.id();
}

bool is_of(const Dismissal& dismissal, const Finding& finding) {
    const auto [small, large] = std::minmax(dismissal.size, finding.size);
    return dismissal.kind == finding.kind && large <= kSameSize * small &&
           (dismissal.place - finding.place).norm() <= 0.5 * small;
}

JudgedFindings judged(FindingSearch search, const std::vector<Dismissal>& dismissals) {
    const std::vector<std::optional<std::size_t>> hidden_by =
        nearest_dismissals(search.findings, dismissals);
    JudgedFindings result{.not_searched = std::move(search.not_searched)};
    for (const Dismissal& dismissal : dismissals) result.dismissed.push_back({dismissal, {}});
    for (std::size_t i = 0; i < search.findings.size(); ++i) {
        Finding& finding = search.findings[i];
        if (const auto dismissal = hidden_by[i])
            result.dismissed[*dismissal].finding = std::move(finding);
        else
            result.open.push_back(std::move(finding));
    }
    return result;
}

std::vector<Dismissal> stored_dismissals(const std::filesystem::path& project) {
    const std::string text = stored_text(project, StoredText::Dismissals);
    std::vector<Dismissal> dismissals;
    if (text.empty()) return dismissals;
    const Json json = json_from_text(text, "the stored dismissals");
    if (!json.is_array()) refuse_json(json, "dismissals", "a list");
    for (std::size_t i = 0; i < json.size(); ++i)
        dismissals.push_back(dismissal_from(json[i], "dismissals[" + std::to_string(i) + "]"));
    return dismissals;
}

void dismiss(const std::filesystem::path& project, const FindingSearch& search,
             const Finding& finding, const std::string& reason) {
    require_reason(reason);
    const std::vector<Dismissal> earlier = stored_dismissals(project);
    std::vector<Dismissal> dismissals;
    for (const auto& [dismissal, hidden] : judged(search, earlier).dismissed)
        if (!hidden || hidden->id() != finding.id()) dismissals.push_back(dismissal);
    dismissals.push_back({.kind = finding.kind,
                          .place = finding.place,
                          .size = finding.size,
                          .reason = reason,
                          .author = login_name(),
                          .time = utc_now()});
    store(project, dismissals,
          {.subject = "finding " + finding.id(), .facts = Json{{"dismissed", reason}}.dump()});
}

std::optional<Dismissal> restore(const std::filesystem::path& project, const std::string& id) {
    const FindingId wanted = finding_id_from(id);
    std::vector<Dismissal> dismissals = stored_dismissals(project);
    const auto distance = [&](const Dismissal& one) {
        return wanted.distance(one.kind, one.place, one.size);
    };
    const auto nearest = std::ranges::min_element(dismissals, {}, distance);
    if (nearest == dismissals.end() || !std::isfinite(distance(*nearest))) return std::nullopt;
    Dismissal restored = std::move(*nearest);
    dismissals.erase(nearest);
    store(project, dismissals,
          {.subject = "finding " + restored.id(), .facts = Json{{"restored", true}}.dump()});
    return restored;
}

}  // namespace vesselbench
