#include "workbench/window/core/remedies.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// A longer value makes a button that nobody reads.
constexpr std::size_t kLongestValue = 24;

const LogEntry* entry_of(const Document& document, const Message& message) {
    if (!message.edit || !document.snapshot()) return nullptr;
    return find_entry(*document.snapshot(), *message.edit);
}

/// True if the remedy is other arguments of what the message is about.
bool is_own(const Message& message, const Remedy& remedy) {
    return !remedy.before && remedy.operation == message.operation;
}

bool has_parameters(const Operation& operation, const Remedy& remedy) {
    return std::ranges::all_of(remedy.arguments, [&](const auto& argument) {
        return std::ranges::count(operation.parameters, argument.first, &Parameter::name) > 0;
    });
}

bool can_follow(const Document& document, const Message& message, const Remedy& remedy) {
    const bool lost = message.edit && entry_of(document, message) == nullptr;
    if (remedy.action != RemedyAction::Give) return message.edit && !lost;
    if (is_own(message, remedy) && (lost || remedy.arguments.empty())) return false;
    const Operation* operation = known_operation(remedy.operation);
    return operation != nullptr && has_parameters(*operation, remedy);
}

std::string with_small_letter(std::string words) {
    if (!words.empty())
        words[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(words[0])));
    return words;
}

/// What becomes of a field: "set edge to 0.5 mm".
std::string change_of(const Parameter& parameter, const std::string& value) {
    const std::string name = with_small_letter(readable(parameter.name));
    if (value.empty()) {
        if (pick_target(parameter)) return "pick " + name;
        return (parameter.type == ParameterType::File ? "choose " : "change ") + name;
    }
    if (parameter.type == ParameterType::Flag)
        return (value == "true" ? "turn on " : "turn off ") + name;
    const bool place = parameter.type == ParameterType::Point ||
                       parameter.type == ParameterType::List || value.size() > kLongestValue;
    if (place) return "fill in " + name;
    const std::string unit = readable_unit(parameter.unit);
    return "set " + name + " to " + value + (unit.empty() ? "" : " " + unit);
}

/// The edit of an operation that a case has once, as the one that loads its source; none: edits of
/// it can be added.
std::optional<EditId> only_edit(const Document& document, const Operation& operation) {
    const auto& loads = operation.recipe.loads;
    const bool loads_source = loads && *loads != InputKind::Neighbour;
    if (!loads_source && &operation != &extracting_operation()) return std::nullopt;
    for (const LogEntry& entry : document.snapshot()->log)
        if (entry.edit.operation == operation.name && entry.edit.place.step == Step::Source)
            return entry.edit.edit.id;
    return std::nullopt;
}

bool shows_form(const Core& place, const Message& message) {
    const auto& form = place.form();
    if (!form || form->operation().name != message.operation) return false;
    return !message.edit || form->edit() == message.edit;
}

/// What was typed into the form that was refused stays.
void open_form(Core& place, const Message& message, const Remedy& remedy) {
    if (is_own(message, remedy)) {
        if (shows_form(place, message)) return;
        return message.edit ? place.choose_edit(*message.edit) : place.choose(remedy.operation);
    }
    const Operation& operation = find_operation(remedy.operation);
    if (const auto edit = only_edit(place.document, operation); edit && !remedy.before)
        return place.choose_edit(*edit);
    // Beside what was refused: edits of earlier steps stay as they are.
    const bool refused = !message.edit && place.form();
    place.choose(remedy.operation, refused ? std::optional(place.step()) : std::nullopt);
}

void let_choose(Core& place, const Parameter& parameter) {
    const std::string& name = parameter.name;
    if (parameter.type == ParameterType::File) return place.ask(FileQuestion::Parameter, name);
    if (!pick_target(parameter)) return place.want_field(name);
    if (place.armed() != name) place.arm(name);
}

void fill_in(Core& place, const Remedy& remedy) {
    if (!place.form()) return;
    const Operation& operation = place.form()->operation();
    const Parameter* to_choose = nullptr;
    for (const auto& [name, value] : remedy.arguments) {
        if (!value.empty())
            place.set_field(name, value);
        else if (to_choose == nullptr)
            to_choose = &find_parameter(operation, name);
    }
    if (to_choose != nullptr) let_choose(place, *to_choose);
}

}  // namespace

std::vector<Remedy> remedies_of(const Document& document, const Message& message) {
    std::vector<Remedy> remedies;
    if (!document.is_open()) return remedies;
    std::ranges::copy_if(message.remedies, std::back_inserter(remedies), [&](const Remedy& remedy) {
        return can_follow(document, message, remedy);
    });
    return remedies;
}

std::string remedy_label(const std::string& about, const Remedy& remedy) {
    if (remedy.action == RemedyAction::Remove) return "Remove " + readable(about);
    if (remedy.action == RemedyAction::ChooseAgain)
        return "Let " + readable(about) + " choose again";
    const Operation& operation = find_operation(remedy.operation);
    std::vector<std::string> changes;
    for (const auto& [name, value] : remedy.arguments)
        changes.push_back(change_of(find_parameter(operation, name), value));
    const std::string words = joined(changes, " and ");
    if (remedy.operation == about && !remedy.before) return readable_sentence(words);
    return readable(remedy.operation) + (words.empty() ? "" : ": " + words);
}

std::string button_of(const Document& document, const Message& message) {
    if (const auto remedies = remedies_of(document, message); !remedies.empty())
        return remedy_label(message.operation, remedies.front());
    const LogEntry* entry = entry_of(document, message);
    return entry == nullptr ? "" : "Go to " + readable(entry->edit.operation);
}

void follow(Core& place, const Message& message) {
    if (const auto remedies = remedies_of(place.document, message); !remedies.empty())
        return follow(place, message, remedies.front());
    if (entry_of(place.document, message) != nullptr) place.choose_edit(*message.edit);
}

void follow(Core& place, Message message, Remedy remedy) {
    if (!can_follow(place.document, message, remedy)) return;
    if (remedy.action == RemedyAction::Give) {
        open_form(place, message, remedy);
        return fill_in(place, remedy);
    }
    const EditRecord edit = entry_of(place.document, message)->edit;
    place.leave_form();
    if (remedy.action == RemedyAction::Remove)
        place.document.remove(edit.edit.id);
    else
        place.document.change(edit.edit.id, edit.given);
}

}  // namespace vesselbench
