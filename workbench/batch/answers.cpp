#include "workbench/batch/answers.h"

#include <array>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The option of `prepare` that gives an end its role.
std::string option_for(EndRole role) {
    return role == EndRole::Closed ? "close" : to_string(role);
}

bool is_about_ends(const CaseValue& value) {
    return value.option == option_for(EndRole::Inlet) ||
           value.option == option_for(EndRole::Open) || value.option == option_for(EndRole::Closed);
}

/// With a point in each coordinate: whole numbers would be those of ends.
std::string argument_for(const Vec3& place) {
    constexpr const char* kMicrometresAndFiner = "%.6f";
    return formatted(place.x(), kMicrometresAndFiner) + "," +
           formatted(place.y(), kMicrometresAndFiner) + "," +
           formatted(place.z(), kMicrometresAndFiner);
}

AnsweredEnd end_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const auto at = fields.required<std::array<double, 3>>("place_mm");
    const auto answer = fields.required<std::string>("answer");
    fields.refuse_unknown_keys();
    const std::optional<EndRole> role = end_role(answer);
    if (!role) refuse_json(answer, fields.place_of("answer"), "inlet, open or closed");
    return {Vec3(at[0], at[1], at[2]), *role};
}

/// The objects of a list that has at least one.
const Json& list_in(JsonFields& fields, const char* key) {
    const Json* list = fields.child(key);
    if (list == nullptr || !list->is_array() || list->empty())
        refuse_json(list == nullptr ? Json() : *list, fields.place_of(key), "a list");
    return *list;
}

std::string item_of(const JsonFields& fields, const char* list, std::size_t i) {
    return fields.place_of(list) + "[" + std::to_string(i) + "]";
}

std::pair<std::string, CaseAnswers> case_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    const auto name = fields.required<std::string>("case");
    CaseAnswers answers{.sha256 = fields.required<std::string>("sha256"), .ends = {}};
    const Json& ends = list_in(fields, "ends");
    fields.refuse_unknown_keys();
    for (std::size_t i = 0; i < ends.size(); ++i)
        answers.ends.push_back(end_from(ends[i], item_of(fields, "ends", i)));
    return {name, std::move(answers)};
}

Json end_json(const AnsweredEnd& end) {
    return {{"place_mm", {end.place.x(), end.place.y(), end.place.z()}},
            {"answer", to_string(end.role)}};
}

}  // namespace

Answers answers_in(const fs::path& file) {
    const Json json = json_from_file(file);
    JsonFields fields(json, "'" + bare_name(file) + "'");
    const Json& list = list_in(fields, "answers");
    fields.refuse_unknown_keys();
    Answers answers;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = item_of(fields, "answers", i);
        auto [name, of_case] = case_from(list[i], place);
        if (!answers.emplace(name, std::move(of_case)).second)
            throw InvalidInput(place + ": the case '" + shortened(printable(name)) +
                               "' has been answered above");
    }
    return answers;
}

std::string text_of(const Answers& answers) {
    Json list = Json::array();
    for (const auto& [name, of_case] : answers) {
        Json ends = Json::array();
        for (const AnsweredEnd& end : of_case.ends) ends.push_back(end_json(end));
        list.push_back({{"case", name}, {"sha256", of_case.sha256}, {"ends", std::move(ends)}});
    }
    return text_from_json(Json({{"answers", std::move(list)}}), 1) + "\n";
}

BatchCase answered(BatchCase one, const CaseAnswers& answers) {
    std::erase_if(one.values, is_about_ends);
    for (const AnsweredEnd& end : answers.ends)
        one.values.push_back({option_for(end.role), argument_for(end.place)});
    return one;
}

}  // namespace vesselbench
