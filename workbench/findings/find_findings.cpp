#include "workbench/findings/find_findings.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/point_json.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/question.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// A damaged surface is what some detectors refuse, and what others find.
std::vector<Finding> found_by(const Detector& detector, FindingSubject& subject,
                              std::vector<NotSearched>& not_searched, const Progress& progress) {
    try {
        return detector.find(subject, progress);
    } catch (const AlgorithmFailure& failure) {
        not_searched.push_back({detector.kind, failure.what()});
    } catch (const InvalidInput& failure) {
        not_searched.push_back({detector.kind, failure.what()});
    }
    return {};
}

/// True if a finding that is there already is the cause of this one.
bool is_explained(const Finding& finding, const std::vector<Finding>& earlier) {
    constexpr double kBeside = 1.5;   ///< [sum of the two sizes]
    constexpr double kLargest = 2.0;  ///< [sizes]: a whole piece apart explains little beside it
    return std::ranges::any_of(earlier, [&](const Finding& cause) {
        return cause.kind != finding.kind && cause.certainty >= finding.certainty &&
               (cause.place - finding.place).norm() <
                   kBeside * (std::min(cause.size, kLargest * finding.size) + finding.size);
    });
}

/// The row of a kind: the graver an error of the model it is, the earlier it comes.
std::size_t row_of_kind(const std::string& kind) {
    const std::span<const Detector> all = detectors();
    return static_cast<std::size_t>(std::ranges::find(all, kind, &Detector::kind) - all.begin());
}

Json treatment_json(const Finding& finding) {
    const Remedy* treatment = finding.treatment();
    if (treatment == nullptr) return nullptr;
    Json arguments = Json::object();
    for (const auto& [name, value] : treatment->arguments) arguments[name] = value;
    return {{"name", treatment->operation}, {"arguments", arguments}};
}

Json readings_json(const Finding& finding) {
    Json readings = Json::array();
    for (const Reading& reading : finding.readings)
        readings.push_back({{"key", reading.key},
                            {"name", reading.name},
                            {"anatomy", reading.anatomy},
                            {"odds", reading.odds ? Json(*reading.odds) : Json(nullptr)},
                            {"text", reading_words(reading)},
                            {"evidence", diagnostics_json(reading.evidence)}});
    return readings;
}

Json dismissal_json(const Dismissal& dismissal) {
    return {{"kind", dismissal.kind},     {"place_mm", point_json(dismissal.place)},
            {"size_mm", dismissal.size},  {"reason", dismissal.reason},
            {"author", dismissal.author}, {"time", dismissal.time}};
}

}  // namespace

void put_worst_first(std::vector<Finding>& findings) {
    std::ranges::stable_sort(findings, std::greater{}, &Finding::certainty);
    const auto listed = static_cast<std::ptrdiff_t>(listed_count(findings));
    std::ranges::stable_sort(findings.begin(), findings.begin() + listed, std::less{},
                             [](const Finding& finding) { return row_of_kind(finding.kind); });
}

FindingSearch find_findings(const Scene& scene, const Progress& progress) {
    return find_findings(scene, {}, progress);
}

FindingSearch find_findings(const Scene& scene, const std::vector<StatedEnd>& stated,
                            const Progress& progress) {
    static_cast<void>(surface_of(scene));
    FindingSubject subject(scene, stated);
    FindingSearch search;
    const std::span<const Detector> all = detectors();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto share = [&](std::size_t k) {
            return static_cast<double>(k) / static_cast<double>(all.size());
        };
        progress.report(share(i), "looking for artefacts");
        for (Finding& finding : found_by(all[i], subject, search.not_searched,
                                         progress.part(share(i), share(i + 1)).silent())) {
            if (all[i].follows && is_explained(finding, search.findings)) continue;
            finding.evidence.place = finding.place;
            search.findings.push_back(std::move(finding));
        }
    }
    put_worst_first(search.findings);
    return search;
}

std::vector<std::string> not_searched_lines(const std::vector<NotSearched>& not_searched) {
    std::vector<std::pair<std::string, std::string>> titles;  // by reason
    for (const auto& [kind, reason] : not_searched) {
        const auto known =
            std::ranges::find(titles, reason, &std::pair<std::string, std::string>::first);
        if (known == titles.end())
            titles.emplace_back(reason, title_of_kind(kind));
        else
            known->second += ", " + title_of_kind(kind);
    }
    std::vector<std::string> lines;
    for (const auto& [reason, kinds] : titles)
        lines.push_back("not looked for: " + kinds + ": " + reason);
    return lines;
}

Json finding_json(const Finding& finding) {
    return {{"id", finding.id()},
            {"kind", finding.kind},
            {"title", title_of(finding)},
            {"certainty", finding.certainty},
            {"certain_of", certain_of_kind(finding.kind)},
            {"place_mm", point_json(finding.place)},
            {"size_mm", finding.size},
            {"text", worded(finding.evidence)},
            {"evidence", diagnostic_json(finding.evidence)},
            {"readings", readings_json(finding)},
            {"operation", treatment_json(finding)}};
}

Json findings_json(const JudgedFindings& findings) {
    Json json = {
        {"findings", Json::array()}, {"dismissed", Json::array()}, {"not_searched", Json::array()}};
    for (const Finding& finding : findings.open) json["findings"].push_back(finding_json(finding));
    for (const DismissedFinding& dismissed : findings.dismissed) {
        json["dismissed"].push_back(dismissal_json(dismissed.dismissal));
        json["dismissed"].back()["id"] =
            dismissed.finding ? Json(dismissed.finding->id()) : Json(nullptr);
    }
    for (const auto& [kind, reason] : findings.not_searched)
        json["not_searched"].push_back({{"kind", kind}, {"reason", reason}});
    return json;
}

}  // namespace vesselbench
