#include "workbench/prepare/end_question.h"

#include <algorithm>
#include <array>
#include <set>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/clipping_record.h"
#include "workbench/operations/clip_opening/planned_ends.h"
#include "workbench/prepare/before_cuts.h"
#include "workbench/prepare/end_picture.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Null: it is about something else.
const DiagnosedFailure* doubt_in(const std::exception& error) {
    const auto* failure = dynamic_cast<const DiagnosedFailure*>(&error);
    return failure != nullptr && failure->diagnostics().front().code == kEndInDoubt ? failure
                                                                                    : nullptr;
}

/// The sentence without the list of the ends and the commands.
std::string sentence_of(const Diagnostic& diagnostic) {
    const auto doubts = diagnostic.words.find("doubts");
    return text_of({.code = diagnostic.code,
                    .words = {{"doubts", doubts == diagnostic.words.end() ? "" : doubts->second}}});
}

std::set<int> numbers_in(const std::vector<Diagnostic>& diagnostics) {
    std::set<int> numbers;
    for (const Diagnostic& diagnostic : diagnostics)
        if (const auto number = diagnostic.figures.find("number");
            number != diagnostic.figures.end())
            numbers.insert(static_cast<int>(number->second));
    return numbers;
}

/// \param plan with its ends by their numbers
Json question_json(const OpeningPlan& plan, const std::vector<Diagnostic>& doubts) {
    const std::set<int> in_doubt = numbers_in(doubts);
    Json ends = ends_json(plan, planned_names(plan));
    for (std::size_t i = 0; i < plan.ends.size(); ++i) {
        const EndRecord& end = plan.ends[i];
        const bool doubtful = in_doubt.contains(end.number);
        const bool counts = doubtful || end.share() > kLeastShare;
        const EndRole role = planned_role(plan, end);
        ends[i]["proposal"] = to_string(role);
        ends[i]["in_doubt"] = doubtful;
        ends[i]["counts"] = counts;
        // What goes with another end's cut is not to be closed by itself. Where inlets are named,
        // no other end is one.
        ends[i]["stated"] = doubtful || end.asked || end.wanted || role == EndRole::Inlet ||
                            (counts && end.fate != EndFate::Removed);
    }
    return {{"doubt", sentence_of(doubts.front())}, {"ends", std::move(ends)}};
}

/// Empty without usable OpenGL.
std::string picture_if_any(const Surface& surface, const OpeningPlan& plan) {
    try {
        return png(picture_of_ends(surface, plan));
    } catch (const GpuUnavailable&) {
        return {};
    }
}

QuestionedEnd end_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const auto at = fields.required<std::array<double, 3>>("place_mm");
    const Json* odds = fields.child("odds");
    JsonFields likely(odds == nullptr ? json : *odds, fields.place_of("odds"));
    const auto role = end_role(fields.required<std::string>("proposal"));
    if (!role) throw InvalidInput(place + " has no known role");
    return {.number = fields.required<int>("number"),
            .place = Vec3(at[0], at[1], at[2]),
            .diameter = fields.required<double>("diameter_mm"),
            .share = fields.required<double>("flow_share"),
            .opening = likely.required<double>("opening"),
            .sac = likely.required<double>("sac"),
            .why = fields.required<std::string>("why"),
            .proposal = *role,
            .in_doubt = fields.required<bool>("in_doubt"),
            .counts = fields.required<bool>("counts"),
            .stated = fields.required<bool>("stated")};
}

/// The ends without a number are parts of others.
EndQuestion question_from(const Json& json) {
    JsonFields fields(json, kEndQuestion);
    EndQuestion question{.doubt = fields.required<std::string>("doubt"), .ends = {}};
    const Json* ends = fields.child("ends");
    for (std::size_t i = 0; ends != nullptr && i < ends->size(); ++i) {
        const Json& end = ends->at(i);
        if (end.is_object() && end.contains("number") && !end["number"].is_null())
            question.ends.push_back(
                end_from(end, fields.place_of("ends") + "[" + std::to_string(i) + "]"));
    }
    return question;
}

}  // namespace

void write_end_question(Session& session, const Recipe& recipe, const PrepareOptions& options,
                        const std::exception& error, const Progress& progress) {
    const DiagnosedFailure* doubt = doubt_in(error);
    const auto cut = std::ranges::find_if(recipe, cuts_ends);
    if (doubt == nullptr || cut == recipe.end()) return;
    PendingFiles files;
    try {
        const Scene scene = session.scene(options.purpose);
        OpeningPlan plan = planned_openings(scene, checked_arguments(cut->given), progress);
        plan.ends = ends_by_number(plan);
        files.add_text(options.out / kEndQuestion,
                       text_from_json(question_json(plan, doubt->diagnostics()), 2) + "\n");
        const std::string picture = picture_if_any(surface_of(scene), plan);
        if (!picture.empty()) files.add_text(options.out / kEndQuestionPicture, picture);
    } catch (const AlgorithmFailure&) {
        return;  // the doubt itself has been reported
    }
    files.commit();
}

std::optional<EndQuestion> read_end_question(const fs::path& folder) {
    try {
        return question_from(
            json_from_text(file_content(folder / kEndQuestion), kEndQuestion, kLargestStoredJson));
    } catch (const IoError&) {
        return std::nullopt;
    } catch (const InvalidInput&) {
        return std::nullopt;
    }
}

}  // namespace vesselbench
