#include "workbench/prepare/edits_recipe.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/case_files.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// A value that means something in this case alone: a place, a file, an opening.
bool is_of_this_case(const Parameter& parameter) {
    switch (parameter.meaning) {
        case Meaning::Place:
        case Meaning::Tip:
        case Meaning::Branch:
        case Meaning::Inlet:
        case Meaning::InletEnd:
        case Meaning::Seed:
        case Meaning::Box:
        case Meaning::Openings:
        case Meaning::Planes:
        case Meaning::Roles:
        case Meaning::Neck:
        case Meaning::Dabs:
            return true;
        default:
            return parameter.type == ParameterType::File ||
                   parameter.type == ParameterType::Records ||
                   (parameter.type == ParameterType::List && parameter.unit == "mm");
    }
}

/// True if an edit without the value does the same, with what it finds by itself in its place: of
/// hints about ends, and of decisions.
bool is_hint(const Parameter& parameter) {
    return parameter.use == Use::Decision || parameter.meaning == Meaning::Inlet ||
           parameter.meaning == Meaning::InletEnd ||
           (parameter.meaning == Meaning::Tip && parameter.type == ParameterType::List);
}

bool is_default(const Parameter& parameter, const Value& value) {
    return parameter.default_value && to_text(*parameter.default_value) == to_text(value);
}

/// What an edit's result comes from: what was given, or the decisions with which it ran again.
Arguments arguments_of(const LogEntry& entry, const Operation& operation, const Snapshot& now) {
    const PastEdit& past = now.past->at(entry.edit.edit);
    if (!entry.result || !past.first || entry.result->id == past.first->id) return entry.edit.given;
    Arguments arguments = entry.edit.given;
    for (const Parameter& parameter : operation.parameters) {
        const auto found = entry.result->resolved.values().find(parameter.name);
        if (found != entry.result->resolved.values().end() && !is_default(parameter, found->second))
            arguments.set(parameter.name, found->second);
    }
    return arguments;
}

/// An edit as an entry: its arguments, and what of them is of this case.
struct EditEntry {
    Arguments arguments;
    std::vector<std::string> bound;
    bool is_portable = true;  ///< without `bound`
};

EditEntry entry_of(const Operation& operation, Arguments arguments) {
    const bool loads_input =
        operation.recipe.loads && operation.recipe.loads != InputKind::Neighbour;
    EditEntry edit{.arguments = std::move(arguments)};
    for (const Parameter& parameter : operation.parameters) {
        if (!edit.arguments.has(parameter.name)) continue;
        if (loads_input && parameter.type == ParameterType::File) {
            edit.arguments.remove(parameter.name);
        } else if (loads_input || is_of_this_case(parameter)) {
            edit.bound.push_back(parameter.name);
            edit.is_portable = edit.is_portable && !loads_input && is_hint(parameter);
        }
    }
    return edit;
}

/// In one line, with a space behind each colon and comma.
std::string line_of(const Json& json) {
    if (!json.is_structured() || json.empty()) return text_from_json(json);
    std::string text;
    for (const auto& [key, value] : json.items())
        text += (text.empty() ? "" : ", ") +
                (json.is_object() ? text_from_json(Json(key)) + ": " : "") + line_of(value);
    return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

std::string entry_line(const LogEntry& entry, const Operation& operation,
                       const Arguments& arguments) {
    Json json = {{"operation", operation.name}};
    if (entry.edit.place.step != operation.usual_step)
        json["step"] = to_string(entry.edit.place.step);
    if (!arguments.values().empty()) json["arguments"] = to_json(arguments);
    return line_of(with_file_names(Json::array({json}))[0]);
}

/// A line: a text of a stranger's project must not end the comment.
std::string comment(const std::string& text) {
    std::string line = printable(text);
    for (char& letter : line)
        if (letter == '\n' || letter == '\r') letter = ' ';
    return "    // " + line + "\n";
}

/// What a recipe says of an edit: comments, and its entry unless that is left out.
struct EditText {
    std::string comments, entry;
};

EditText text_of_edit(const LogEntry& entry, const Snapshot& now, bool portable) {
    const std::string number =
        "edit " + std::to_string(entry.edit.edit.id) + ", " + entry.edit.operation;
    const Operation* operation = known_operation(entry.edit.operation);
    if (operation == nullptr || entry.status == EditStatus::Stale)
        return {comment(number + ", no longer applies and is left out"), ""};
    EditEntry edit =
        entry_of(*operation, portable ? entry.edit.given : arguments_of(entry, *operation, now));
    EditText text;
    if (portable && !edit.is_portable) {
        if (!operation->recipe.loads)
            text.comments =
                comment(number + ", is left out: it is of this case (" + joined(edit.bound) + ")");
        return text;
    }
    if (portable)
        for (const std::string& name : edit.bound) edit.arguments.remove(name);
    else if (!edit.bound.empty())
        text.comments = comment("of this case: " + joined(edit.bound));
    if (!entry.edit.note.empty()) text.comments += comment(entry.edit.note);
    if (operation->recipe.loads && edit.arguments.values().empty()) return text;
    text.entry = "    " + entry_line(entry, *operation, edit.arguments);
    return text;
}

}  // namespace

std::string recipe_of_edits(const Snapshot& now, const std::string& variant, bool portable) {
    std::vector<EditText> edits;
    bool has_own = false;
    for (const LogEntry& entry : now.log) {
        if (!is_part_of(entry.edit.place, variant)) continue;
        has_own = has_own || entry.edit.place.variant == variant;
        edits.push_back(text_of_edit(entry, now, portable));
    }
    auto commas = std::ranges::count_if(edits, [](const EditText& e) { return !e.entry.empty(); });
    std::string text =
        "{\n  \"title\": " + text_from_json(Json("Edits of " + printable(now.project))) + ",\n";
    if (has_own && std::ranges::count(purpose_names(), variant) > 0)
        text += "  \"for\": " + text_from_json(Json(variant)) + ",\n";
    text += "  \"entries\": [\n";
    for (const EditText& edit : edits) {
        text += edit.comments;
        if (!edit.entry.empty()) text += edit.entry + (--commas > 0 ? ",\n" : "\n");
    }
    return text + "  ]\n}\n";
}

}  // namespace vesselbench
