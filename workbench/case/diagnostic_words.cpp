#include "workbench/case/diagnostic_words.h"

#include <algorithm>

#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/readable_name.h"
#include "workbench/case/shell_text.h"

namespace vesselbench {

namespace {

bool is_own(const Diagnostic& diagnostic, const Remedy& remedy) {
    return remedy.operation.empty() || remedy.operation == diagnostic.operation;
}

/// True if it can be given as it is.
bool is_complete(const Remedy& remedy) {
    return !remedy.arguments.empty() &&
           std::ranges::none_of(remedy.arguments,
                                [](const auto& argument) { return argument.second.empty(); });
}

/// "Edge" = 0.2
std::string field_text(const std::string& name, const std::string& value) {
    const std::string field = "\"" + readable(name) + "\"";
    if (value.empty()) return field;
    return field + (value == "true" ? " on" : value == "false" ? " off" : " = " + value);
}

std::string window_remedy(const Diagnostic& diagnostic, const Remedy& remedy) {
    if (remedy.action != RemedyAction::Give) return plain_remedy(diagnostic, remedy);
    std::vector<std::string> fields;
    for (const auto& [name, value] : remedy.arguments) fields.push_back(field_text(name, value));
    if (is_own(diagnostic, remedy) && !fields.empty()) return joined(fields);
    const std::string operation = readable(remedy.operation);
    return fields.empty() ? operation : operation + " with " + joined(fields);
}

/// "edge=0.2 blend=1", each quoted for a shell if that is necessary.
std::string argument_words(const Remedy& remedy, const std::string& prefix = "") {
    std::vector<std::string> words;
    for (const auto& [name, value] : remedy.arguments)
        words.push_back(shell_quoted(prefix + name + "=" + value));
    return joined(words, prefix.empty() ? " " : " --set ");
}

/// For an edit that is known: "vesselbench change case.vbench 4 edge=0.2".
std::string edit_command(const Remedy& remedy, const std::string& project, std::int64_t edit) {
    const bool remove = remedy.action == RemedyAction::Remove;
    std::string command = std::string("vesselbench ") + (remove ? "remove " : "change ") +
                          shell_quoted(project) + " " + std::to_string(edit);
    if (remove) return command;
    return command + " " +
           (remedy.action == RemedyAction::ChooseAgain ? "--anew" : argument_words(remedy));
}

std::string command_remedy(const Diagnostic& diagnostic, const Remedy& remedy,
                           const Audience& audience) {
    const std::string operation =
        remedy.operation.empty() ? diagnostic.operation : remedy.operation;
    const bool about_edit = remedy.action != RemedyAction::Give;
    if (audience.project.empty() || operation.empty() || (about_edit && !diagnostic.edit) ||
        (!about_edit && !is_complete(remedy)))
        return plain_remedy(diagnostic, remedy);
    const bool own = is_own(diagnostic, remedy) && !remedy.before;
    if (own && !diagnostic.edit && audience.preparing)
        return "`--resume --set " + argument_words(remedy, operation + ".") + "`";
    if (own && diagnostic.edit)
        return "`" + edit_command(remedy, audience.project, *diagnostic.edit) + "`";
    return "`vesselbench apply " + shell_quoted(audience.project) + " " + operation + " " +
           argument_words(remedy) + "`" +
           (remedy.before && audience.preparing ? ", then --resume," : "");
}

}  // namespace

std::string worded(const Diagnostic& diagnostic, const Audience& audience) {
    return text_of(diagnostic, [&](const Diagnostic& about, const Remedy& remedy) {
        return audience.window ? window_remedy(about, remedy)
                               : command_remedy(about, remedy, audience);
    });
}

std::string worded_with_operation(const Diagnostic& diagnostic, const Audience& audience) {
    const std::string text = worded(diagnostic, audience);
    if (diagnostic.operation.empty()) return text;
    return (audience.window ? readable(diagnostic.operation) : diagnostic.operation) + ": " + text;
}

std::vector<std::string> worded(const std::vector<Diagnostic>& diagnostics,
                                const Audience& audience) {
    std::vector<std::string> texts;
    for (const Diagnostic& diagnostic : diagnostics) texts.push_back(worded(diagnostic, audience));
    return texts;
}

}  // namespace vesselbench
