#include "workbench/batch/questions_page.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/batch/page_parts.h"
#include "workbench/batch/page_texts.h"
#include "workbench/case/json_text.h"
#include "workbench/report/base64.h"
#include "workbench/report/rendered_template.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
    return formatted(100.0 * share, "%.0f %%");
}

/// \param name of its radio buttons
Json row_json(const QuestionedEnd& end, const std::string& name) {
    Json roles = Json::array();
    for (const EndRole role : {EndRole::Inlet, EndRole::Open, EndRole::Closed})
        roles.push_back({{"role", to_string(role)}, {"proposed", role == end.proposal}});
    return {{"radio", name},
            {"number", std::to_string(end.number)},
            {"place_mm", text_from_json({end.place.x(), end.place.y(), end.place.z()})},
            {"place", coordinates_text(end.place)},
            {"diameter", formatted(end.diameter)},
            {"share", percent(end.share)},
            {"opening", percent(end.opening)},
            {"sac", percent(end.sac)},
            {"why", or_false(end.why)},
            {"proposal", to_string(end.proposal)},
            {"in_doubt", end.in_doubt},
            {"stated", end.stated},
            {"roles", std::move(roles)}};
}

/// Ends with a summary; folded away if nobody needs to look at them.
Json group_json(const std::vector<QuestionedEnd>& ends, bool counts, const std::string& prefix) {
    Json rows = Json::array();
    std::size_t open = 0;
    for (const QuestionedEnd& end : ends) {
        if (end.counts != counts) continue;
        rows.push_back(row_json(end, prefix + std::to_string(end.number)));
        if (end.proposal != EndRole::Closed) ++open;
    }
    const std::string count = std::to_string(rows.size());
    const std::string summary = counts ? "ends that matter for the flow: " + count
                                       : "smaller ends: " + count + ", of which " +
                                             std::to_string(open) + " are open as proposed";
    return {{"summary", summary}, {"unfolded", counts}, {"rows", std::move(rows)}};
}

/// \param prefix of the names of its radio buttons
Json case_json(const CaseQuestion& one, const std::string& prefix) {
    Json groups = Json::array();
    for (const bool counts : {true, false})
        if (Json group = group_json(one.question.ends, counts, prefix); !group["rows"].empty())
            groups.push_back(std::move(group));
    return {{"name", one.name},
            {"sha256", one.sha256},
            {"doubt", or_false(one.question.doubt)},
            {"picture", or_false(base64(one.picture))},
            {"groups", std::move(groups)}};
}

}  // namespace

std::string questions_page(const std::vector<CaseQuestion>& questions) {
    const auto& texts = batch_page_texts();
    const std::string script = texts.at("questions.js");
    const std::string style = texts.at("table.css") + texts.at("questions.css");
    Json page = {{"title", "Vessel ends in doubt: " + counted(questions.size(), "case")},
                 {"script_hash", source_hash(script)},
                 {"style_hash", source_hash(style)},
                 {"script", script},
                 {"style", style},
                 {"questions", Json::array()}};
    for (std::size_t i = 0; i < questions.size(); ++i)
        page["questions"].push_back(case_json(questions[i], "end-" + std::to_string(i) + "-"));
    return rendered_template(texts.at("questions.html"), page);
}

}  // namespace vesselbench
