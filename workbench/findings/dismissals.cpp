#include "workbench/findings/dismissals.h"

#include <algorithm>
#include <array>
#include <cctype>

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

/// \param said of the finding, in the record
void store(const std::filesystem::path& project, const std::vector<Dismissal>& dismissals,
           const StoredChange& said) {
    store_text(project, StoredText::Dismissals, text_from_json(json_of(dismissals)), said);
}

}  // namespace

bool is_of(const Dismissal& dismissal, const Finding& finding) {
    const auto [small, large] = std::minmax(dismissal.size, finding.size);
    return dismissal.kind == finding.kind && large <= kSameSize * small &&
           (dismissal.place - finding.place).norm() <= 0.5 * small;
}

JudgedFindings judged(std::vector<Finding> findings, const std::vector<Dismissal>& dismissals) {
    JudgedFindings result;
    for (const Dismissal& dismissal : dismissals) result.dismissed.push_back({dismissal, {}});
    for (Finding& finding : findings) {
        const auto known =
            std::ranges::find_if(result.dismissed, [&](const DismissedFinding& dismissed) {
                return !dismissed.finding && is_of(dismissed.dismissal, finding);
            });
        if (known == result.dismissed.end())
            result.open.push_back(std::move(finding));
        else
            known->finding = std::move(finding);
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

void dismiss(const std::filesystem::path& project, const Finding& finding,
             const std::string& reason) {
    require_reason(reason);
    std::vector<Dismissal> dismissals = stored_dismissals(project);
    std::erase_if(dismissals, [&](const Dismissal& earlier) { return is_of(earlier, finding); });
    dismissals.push_back({.kind = finding.kind,
                          .place = finding.place,
                          .size = finding.size,
                          .reason = reason,
                          .author = login_name(),
                          .time = utc_now()});
    store(project, dismissals,
          {.subject = "finding " + finding.id(), .facts = Json{{"dismissed", reason}}.dump()});
}

bool restore(const std::filesystem::path& project, const Finding& finding) {
    std::vector<Dismissal> dismissals = stored_dismissals(project);
    if (std::erase_if(dismissals, [&](const Dismissal& one) { return is_of(one, finding); }) == 0)
        return false;
    store(project, dismissals,
          {.subject = "finding " + finding.id(), .facts = Json{{"restored", true}}.dump()});
    return true;
}

}  // namespace vesselbench
