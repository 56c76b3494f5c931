#include "workbench/report/first_screen.h"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/listed_finding.h"
#include "workbench/report/report_texts.h"
#include "workbench/report/requirements.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// So many rows fit beside the picture on a screen of 1280 x 800.
constexpr std::size_t kMostOpenings = 6;
/// The same of warnings, and of findings.
constexpr std::size_t kMostLooks = 3;

const char* kGood = "good";
const char* kBad = "bad";

std::size_t count_of(const Json& requirements, Judgement judgement) {
    return static_cast<std::size_t>(std::ranges::count_if(requirements, [&](const Json& row) {
        return member_of(row, "judgement") == to_string(judgement);
    }));
}

void add_missed(Json& verdicts, const Json& requirements) {
    for (const Json& row : requirements)
        if (member_of(row, "judgement") == to_string(Judgement::NotMet))
            verdicts.push_back({{"class", kBad},
                                {"text", "Not met: " + shown_text(member_of(row, "requirement")) +
                                             ", " + shown_text(member_of(row, "limit"))}});
}

/// Of the parts of the report that sum themselves up, as the check of a print does.
void add_headlines(Json& verdicts, const Json& report, std::span<const ReportSection> sections) {
    for (const ReportSection& section : sections) {
        const Json& part = member_of(report, section.key);
        const Json& headline = member_of(part, "headline");
        if (!headline.is_string()) continue;
        const bool refused = headline.get<std::string>().starts_with("not ");
        verdicts.push_back({{"class", refused ? kBad : kGood},
                            {"text", section.title + ": " + headline.get<std::string>()}});
    }
}

Json verdicts_of(const Json& report, std::span<const ReportSection> sections) {
    const Json& requirements = member_of(report, "requirements");
    Json verdicts = Json::array();
    add_missed(verdicts, requirements);
    const std::size_t met = count_of(requirements, Judgement::Met);
    if (verdicts.empty() && met > 0)
        verdicts.push_back(
            {{"class", kGood},
             {"text", "Meets " +
                          (met == 1 ? "the one requirement"
                                    : "all " + std::to_string(met) + " requirements") +
                          " judged for this purpose"}});
    add_headlines(verdicts, report, sections);
    return verdicts;
}

Json openings_of(const Json& report) {
    const Json& all = member_of(report, "openings");
    Json rows = Json::array();
    for (std::size_t i = 0; i < std::min(all.size(), kMostOpenings); ++i) {
        Json row = shown_texts(all[i], {"name", "diameter"});
        row["end"] = end_number(report, member_of(all[i], "name"));
        rows.push_back(std::move(row));
    }
    return rows;
}

Json requirements_of(const Json& report) {
    Json rows = Json::array();
    for (const Json& row : member_of(report, "requirements")) {
        const Json& judgement = member_of(row, "judgement");
        const std::string text = shown_text(judgement);
        rows.push_back({{"requirement", shown_text(member_of(row, "requirement"))},
                        {"class", judgement_class(judgement)},
                        {"judgement", text.substr(0, text.find(':'))}});
    }
    return rows;
}

/// The worst of what to look at: rows with a title and a text.
Json looks_of(const Json& report) {
    Json looks = Json::array();
    for (const Json& warning : member_of(report, "warnings"))
        if (looks.size() < kMostLooks)
            looks.push_back({{"title", ""}, {"text", shown_text(warning)}});
    const std::size_t most = looks.size() + kMostLooks;
    for (const Json& finding : member_of(report, "findings"))
        if (is_listed_finding(finding) && looks.size() < most)
            looks.push_back({{"title", shown_text(member_of(finding, "title"))},
                             {"text", shown_text(member_of(finding, "text"))}});
    return looks;
}

std::size_t looks_in(const Json& report) {
    const Json& findings = member_of(report, "findings");
    return member_of(report, "warnings").size() +
           static_cast<std::size_t>(std::ranges::count_if(findings, is_listed_finding));
}

/// How many rows of a list were left out; empty: none.
std::string rest_text(std::size_t all, std::size_t listed) {
    return all > listed ? std::to_string(all - listed) + " more" : "";
}

}  // namespace

const char* judgement_class(const Json& judgement) {
    if (judgement == to_string(Judgement::Met)) return kGood;
    return judgement == to_string(Judgement::NotMet) ? kBad : "";
}

Json first_screen(const Json& report, std::span<const ReportSection> sections) {
    Json first = {{"verdicts", verdicts_of(report, sections)},
                  {"openings", openings_of(report)},
                  {"requirements", requirements_of(report)},
                  {"looks", looks_of(report)}};
    first["more_openings"] =
        rest_text(member_of(report, "openings").size(), first["openings"].size());
    first["more_looks"] = rest_text(looks_in(report), first["looks"].size());
    for (const char* list : {"openings", "requirements", "looks"})
        first[std::string("any_") + list] = !first[list].empty();
    for (const char* rest : {"more_openings", "more_looks"})
        first[std::string("any_") + rest] = !first[rest].get<std::string>().empty();
    return first;
}

}  // namespace vesselbench
