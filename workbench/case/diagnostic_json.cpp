#include "workbench/case/diagnostic_json.h"

#include <array>
#include <cmath>

#include "geometry/kernel/catalogue.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWarning = "warning";
constexpr const char* kError = "error";

/// JSON has no other numbers.
Json finite_figures(const std::map<std::string, double>& figures) {
    Json json = Json::object();
    for (const auto& [name, figure] : figures)
        if (std::isfinite(figure)) json[name] = figure;
    return json;
}

template <class T>
std::map<std::string, T> map_from(const Json* json, const std::string& place) {
    std::map<std::string, T> values;
    if (json == nullptr) return values;
    if (!json->is_object()) refuse_json(*json, place, "an object");
    for (const auto& [name, value] : json->items())
        values[name] = json_value<T>(value, place + "." + name);
    return values;
}

std::string name_of(RemedyAction action) {
    return action == RemedyAction::Give     ? "give"
           : action == RemedyAction::Remove ? "remove"
                                            : "choose-again";
}

RemedyAction action_from(const std::string& name, const std::string& place) {
    for (const auto action : {RemedyAction::Give, RemedyAction::Remove, RemedyAction::ChooseAgain})
        if (name == name_of(action)) return action;
    throw InvalidInput(place + " must be give, remove or choose-again");
}

Json remedy_json(const Diagnostic& diagnostic, const Remedy& remedy) {
    const bool own = remedy.operation.empty();
    Json json = {{"operation", own ? diagnostic.operation : remedy.operation},
                 {"arguments", remedy.arguments}};
    if (remedy.before) json["before"] = true;
    if (remedy.action != RemedyAction::Give) json["action"] = name_of(remedy.action);
    return json;
}

Remedy remedy_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    Remedy remedy{.operation = fields.required<std::string>("operation")};
    remedy.arguments =
        map_from<std::string>(fields.child("arguments"), fields.place_of("arguments"));
    fields.read("before", remedy.before);
    if (const auto action = fields.optional<std::string>("action"))
        remedy.action = action_from(*action, fields.place_of("action"));
    return remedy;
}

/// \throw InvalidInput unless it is one of the two
Severity severity_from(JsonFields& fields) {
    const auto name = fields.optional<std::string>("severity").value_or(kWarning);
    if (name == kWarning) return Severity::Warning;
    if (name == kError) return Severity::Error;
    throw InvalidInput(fields.place_of("severity") + " must be warning or error");
}

}  // namespace

Json diagnostic_json(const Diagnostic& diagnostic) {
    Json json = {{"code", diagnostic.code},
                 {"severity", diagnostic.severity == Severity::Error ? kError : kWarning},
                 {"text", worded(diagnostic)},
                 {"operation", diagnostic.operation},
                 {"place_mm", nullptr},
                 {"figures", finite_figures(diagnostic.figures)},
                 {"words", diagnostic.words}};
    if (diagnostic.edit) json["edit"] = *diagnostic.edit;
    if (diagnostic.place && diagnostic.place->allFinite())
        json["place_mm"] = point_json(*diagnostic.place);
    json["remedies"] = Json::array();
    for (const Remedy& remedy : diagnostic.remedies)
        json["remedies"].push_back(remedy_json(diagnostic, remedy));
    return json;
}

Json diagnostics_json(const std::vector<Diagnostic>& diagnostics) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) list.push_back(diagnostic_json(diagnostic));
    return list;
}

Json reported_json(const std::vector<Diagnostic>& diagnostics) {
    Json list = diagnostics_json(diagnostics);
    for (std::size_t i = 0; i < diagnostics.size(); ++i)
        if (is_note(diagnostics[i])) list[i]["severity"] = "note";
    return list;
}

Diagnostic diagnostic_from(const Json& json, const std::string& place) {
    if (json.is_string()) return plain_text(json.get<std::string>());
    JsonFields fields(json, place);
    Diagnostic diagnostic{.code = fields.required<std::string>("code"),
                          .severity = severity_from(fields)};
    fields.read("operation", diagnostic.operation);
    diagnostic.edit = fields.optional<std::int64_t>("edit");
    if (const Json* at = fields.child("place_mm"); at != nullptr && !at->is_null()) {
        const auto [x, y, z] = json_value<std::array<double, 3>>(*at, fields.place_of("place_mm"));
        diagnostic.place = Vec3(x, y, z);
    }
    diagnostic.figures = map_from<double>(fields.child("figures"), fields.place_of("figures"));
    diagnostic.words = map_from<std::string>(fields.child("words"), fields.place_of("words"));
    if (const Json* remedies = fields.child("remedies")) {
        if (!remedies->is_array()) refuse_json(*remedies, fields.place_of("remedies"), "a list");
        for (const Json& remedy : *remedies)
            diagnostic.remedies.push_back(remedy_from(remedy, fields.place_of("remedies")));
    }
    return diagnostic;
}

std::vector<Diagnostic> diagnostics_from(const Json& json, const std::string& place) {
    if (!json.is_array()) refuse_json(json, place, "a list");
    std::vector<Diagnostic> diagnostics;
    for (const Json& one : json) diagnostics.push_back(diagnostic_from(one, place));
    return diagnostics;
}

}  // namespace vesselbench
