#include "workbench/review/verdicts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

constexpr std::array<const char*, 4> kNames = {"none", "accept", "reject", "unsure"};

// [bytes]
constexpr std::size_t kLongestName = 400, kLongestComment = 20'000;
constexpr std::size_t kMostMarks = 1'000;  ///< pins, or distances, of an edit
constexpr std::size_t kMostEdits = 100'000;
constexpr double kFarthest = 1e6;  ///< coordinates of a place [mm]

enum class Lines { One, Many };

/// A text of limited length, without control characters.
std::string text_in(JsonFields& fields, const char* key, std::size_t longest, Lines lines) {
    std::string text = fields.required<std::string>(key);
    if (text.size() > longest)
        throw InvalidInput(fields.place_of(key) + " has " + std::to_string(text.size()) +
                           " bytes; at most " + std::to_string(longest) + " are read");
    const auto forbidden = [&](unsigned char c) {
        const bool of_lines = lines == Lines::Many && (c == '\n' || c == '\t' || c == '\r');
        return (c < 0x20 || c == 0x7f) && !of_lines;
    };
    if (std::ranges::any_of(text, forbidden))
        throw InvalidInput(fields.place_of(key) + " contains control characters");
    return text;
}

std::string digest_in(JsonFields& fields, const char* key) {
    std::string text = fields.required<std::string>(key);
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    if (text.size() != 64 || !std::ranges::all_of(text, is_digit))
        throw InvalidInput(fields.place_of(key) + " must be a SHA-256 in 64 hexadecimal digits");
    return text;
}

/// "2024-05-17T09:30:00Z", perhaps with milliseconds, which are left out.
std::string time_in(JsonFields& fields, const char* key) {
    constexpr std::string_view kForm = "0000-00-00T00:00:00";
    std::string text = fields.required<std::string>(key);
    bool fits = text.size() > kForm.size() && text.size() <= 32 && text.back() == 'Z';
    for (std::size_t i = 0; fits && i < text.size() - 1; ++i) {
        const bool digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
        if (i < kForm.size())
            fits = kForm[i] == '0' ? digit : text[i] == kForm[i];
        else
            fits = i == kForm.size() ? text[i] == '.' : digit;
    }
    if (!fits)
        throw InvalidInput(fields.place_of(key) +
                           " must be a UTC time such as 2024-05-17T09:30:00Z, not " +
                           shortened(printable(text)));
    return text.substr(0, kForm.size()) + "Z";
}

Verdict verdict_in(JsonFields& fields, const char* key) {
    const std::string text = fields.required<std::string>(key);
    const auto* found = std::ranges::find(kNames, text);
    if (found == kNames.end())
        throw InvalidInput(fields.place_of(key) + " must be accept, reject, unsure or none, not " +
                           shortened(printable(text)));
    return static_cast<Verdict>(found - kNames.begin());
}

Vec3 place_in(JsonFields& fields, const char* key) {
    const auto numbers = fields.required<std::array<double, 3>>(key);
    for (const double number : numbers)
        if (std::abs(number) > kFarthest)
            throw InvalidInput(fields.place_of(key) + " is no place of a vessel");
    return {numbers[0], numbers[1], numbers[2]};
}

template <class Mark, class Read>
std::vector<Mark> marks_in(JsonFields& fields, const char* key, Read read) {
    std::vector<Mark> marks;
    const auto* list = fields.child(key);
    if (list == nullptr) return marks;
    const std::string place = fields.place_of(key);
    if (!list->is_array()) refuse_json(*list, place, "a list");
    if (list->size() > kMostMarks)
        throw InvalidInput(place + " has " + std::to_string(list->size()) + " entries; at most " +
                           std::to_string(kMostMarks) + " are read");
    for (std::size_t i = 0; i < list->size(); ++i) {
        JsonFields one((*list)[i], place + "[" + std::to_string(i) + "]");
        marks.push_back(read(one));
    }
    return marks;
}

Pin pin_in(JsonFields& fields) {
    return {.place = place_in(fields, "place"),
            .text = text_in(fields, "text", kLongestComment, Lines::Many)};
}

ReviewedDistance distance_in(JsonFields& fields) {
    ReviewedDistance made{.from = place_in(fields, "from"),
                          .to = place_in(fields, "to"),
                          .length = fields.required<double>("mm"),
                          .text = text_in(fields, "text", kLongestComment, Lines::Many)};
    if (made.length < 0.0) throw InvalidInput(fields.place_of("mm") + " is negative");
    return made;
}

EditRef edit_in(JsonFields& fields) {
    const EditRef edit{fields.required<std::int64_t>("edit"), fields.required<int>("revision")};
    if (edit.id < 1 || edit.revision < 1)
        throw InvalidInput(fields.place_of(edit.id < 1 ? "edit" : "revision") +
                           " must be at least 1");
    return edit;
}

EditVerdict edit_verdict_in(JsonFields& fields, const std::string& written) {
    EditVerdict made{.edit = edit_in(fields),
                     .hash = digest_in(fields, "hash"),
                     .verdict = verdict_in(fields, "verdict"),
                     .comment = text_in(fields, "comment", kLongestComment, Lines::Many),
                     .time = written};
    const auto* time = fields.child("time");
    if (time != nullptr && *time != "") made.time = time_in(fields, "time");
    made.pins = marks_in<Pin>(fields, "pins", pin_in);
    made.distances = marks_in<ReviewedDistance>(fields, "distances", distance_in);
    if (made.verdict == Verdict::Reject && made.comment.empty())
        throw InvalidInput(fields.place_of("comment") + " is empty: a rejection needs its reason");
    return made;
}

/// \throw InvalidInput if the object is missing
JsonFields object_in(JsonFields& fields, const char* key, const std::string& name) {
    const auto* object = fields.child(key);
    if (object == nullptr) throw InvalidInput(name + " has no \"" + key + "\"");
    return {*object, fields.place_of(key)};
}

void read_head(JsonFields& fields, VerdictFile& made, const std::string& name) {
    if (fields.required<std::string>("format") != "vesselbench-verdicts")
        throw InvalidInput(name + ".format must be \"vesselbench-verdicts\"");
    if (const auto version = fields.required<std::int64_t>("version"); version != 1)
        throw InvalidInput(name + ".version is " + std::to_string(version) +
                           "; this program reads version 1: use the newer program");
    made.program = text_in(fields, "program", kLongestName, Lines::One);
    JsonFields of_project = object_in(fields, "project", name);
    made.project = text_in(of_project, "id", kLongestName, Lines::One);
    made.project_name = text_in(of_project, "name", kLongestName, Lines::One);
    made.chain_head = digest_in(fields, "chain_head");
    made.written = time_in(fields, "written");
}

void read_reviewer(JsonFields& fields, VerdictFile& made, const std::string& name) {
    JsonFields of_reviewer = object_in(fields, "reviewer", name);
    made.reviewer = text_in(of_reviewer, "name", kLongestName, Lines::One);
    made.role = text_in(of_reviewer, "role", kLongestName, Lines::One);
    if (made.reviewer.find_first_not_of(' ') == std::string::npos)
        throw InvalidInput(of_reviewer.place_of("name") + " is empty: a verdict needs a reviewer");
}

void read_overall(JsonFields& fields, VerdictFile& made) {
    const auto* overall = fields.child("overall");
    if (overall == nullptr) return;
    JsonFields of_overall(*overall, fields.place_of("overall"));
    made.overall = verdict_in(of_overall, "verdict");
    made.overall_comment = text_in(of_overall, "comment", kLongestComment, Lines::Many);
    if (made.overall == Verdict::Reject && made.overall_comment.empty())
        throw InvalidInput(of_overall.place_of("comment") +
                           " is empty: a rejection needs its reason");
}

void read_edits(JsonFields& fields, VerdictFile& made) {
    const auto* edits = fields.child("edits");
    const std::string place = fields.place_of("edits");
    if (edits == nullptr || !edits->is_array())
        refuse_json(edits == nullptr ? nlohmann::ordered_json() : *edits, place, "a list");
    if (edits->size() > kMostEdits) throw InvalidInput(place + " is longer than any history");
    std::set<EditId> seen;
    for (std::size_t i = 0; i < edits->size(); ++i) {
        JsonFields one((*edits)[i], place + "[" + std::to_string(i) + "]");
        made.edits.push_back(edit_verdict_in(one, made.written));
        if (!seen.insert(made.edits.back().edit.id).second)
            throw InvalidInput(one.place_of("edit") + " is in the list twice");
    }
}

nlohmann::json json_of(const EditVerdict& verdict) {
    nlohmann::json pins = nlohmann::json::array(), distances = nlohmann::json::array();
    for (const Pin& pin : verdict.pins)
        pins.push_back({{"place", point_json(pin.place)}, {"text", pin.text}});
    for (const ReviewedDistance& distance : verdict.distances)
        distances.push_back({{"from", point_json(distance.from)},
                             {"to", point_json(distance.to)},
                             {"mm", distance.length},
                             {"text", distance.text}});
    return {{"edit", verdict.edit.id},    {"revision", verdict.edit.revision},
            {"hash", verdict.hash},       {"verdict", to_string(verdict.verdict)},
            {"comment", verdict.comment}, {"time", verdict.time},
            {"pins", std::move(pins)},    {"distances", std::move(distances)}};
}

}  // namespace

std::string to_string(Verdict verdict) {
    return kNames.at(static_cast<std::size_t>(verdict));
}

VerdictFile verdicts_from_text(std::string_view text, const std::string& name) {
    const auto json = json_from_text(text, name, kLargestVerdictFile);
    JsonFields fields(json, name);
    VerdictFile made;
    read_head(fields, made, name);
    read_reviewer(fields, made, name);
    read_overall(fields, made);
    read_edits(fields, made);
    return made;
}

VerdictFile verdicts_from_file(const std::filesystem::path& file) {
    return verdicts_from_text(verdict_text_in(file), bare_name(file));
}

bool says_nothing(const EditVerdict& verdict) {
    return verdict.verdict == Verdict::None && verdict.comment.empty() && verdict.pins.empty() &&
           verdict.distances.empty();
}

std::size_t VerdictFile::said() const {
    return edits.size() - static_cast<std::size_t>(std::ranges::count_if(edits, says_nothing));
}

std::string verdict_text_in(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size > kLargestVerdictFile)
        throw InvalidInput(bare_name(file) + " has " + std::to_string(size) +
                           " bytes; verdicts of at most " + std::to_string(kLargestVerdictFile) +
                           " are read");
    return file_content(file);
}

std::string text_of(const VerdictFile& verdicts) {
    nlohmann::json edits = nlohmann::json::array();
    for (const EditVerdict& verdict : verdicts.edits) edits.push_back(json_of(verdict));
    return nlohmann::json(
               {{"format", "vesselbench-verdicts"},
                {"version", 1},
                {"program", verdicts.program},
                {"project", {{"id", verdicts.project}, {"name", verdicts.project_name}}},
                {"chain_head", verdicts.chain_head},
                {"reviewer", {{"name", verdicts.reviewer}, {"role", verdicts.role}}},
                {"written", verdicts.written},
                {"overall",
                 {{"verdict", to_string(verdicts.overall)}, {"comment", verdicts.overall_comment}}},
                {"edits", std::move(edits)}})
        .dump();
}

}  // namespace vesselbench
