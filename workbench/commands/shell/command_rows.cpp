#include "workbench/commands/shell/command_rows.h"

#include <algorithm>
#include <sstream>

#include "workbench/commands/command_parser.h"
#include "workbench/export/flow_parameters.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/recipe_document.h"
#include "workbench/suggest/processing_subject.h"

namespace vesselbench {

namespace {

/// What the help does not list is in a group without a name.
template <class Listed>
bool is_listed(const Listed& listed) {
    return !listed.get_group().empty();
}

/// Of the operations whose filters are searched.
std::vector<std::string> filter_names() {
    for (const std::string& name : searched_operations(searches_filter))
        for (const Parameter& parameter : find_operation(name).parameters)
            if (parameter.name == "filter") return parameter.choices;
    return {};
}

/// What a kind of value in capitals may be.
std::vector<std::string> words_of_kind(const std::string& value) {
    const std::span<const Operation> flow(&flow_table(), 1);
    if (value == kRecipeValue) return bundled_recipe_names();
    if (value == kFilterValue) return filter_names();
    if (value == kFlowSettingValue) return setting_words(flow);
    if (value != kSettingValue) return {};
    std::vector<std::string> words = setting_words(operation_table());
    std::ranges::copy(setting_words(flow), std::back_inserter(words));
    return words;
}

/// "cfd|rp" is a choice; "FILE|N,N" names two kinds of values.
std::vector<std::string> choices_in(const std::string& value) {
    if (std::vector<std::string> kind = words_of_kind(value); !kind.empty()) return kind;
    const bool words = std::ranges::all_of(
        value, [](char letter) { return letter == '|' || (letter >= 'a' && letter <= 'z'); });
    std::vector<std::string> choices;
    std::istringstream texts(words && value.find('|') != std::string::npos ? value : "");
    for (std::string choice; std::getline(texts, choice, '|');) choices.push_back(choice);
    return choices;
}

OptionRow option_row(const CLI::Option& option) {
    OptionRow row{.name = "--" + option.get_lnames().front(),
                  .letter = {},
                  .value = {},
                  .help = option.get_description(),
                  .choices = {}};
    if (!option.get_snames().empty()) row.letter = "-" + option.get_snames().front();
    if (option.get_items_expected_max() == 0) return row;
    row.value = option.get_type_name().empty() ? "VALUE" : option.get_type_name();
    row.choices = choices_in(row.value);
    row.takes_files = row.value.starts_with("FILE");
    return row;
}

std::string positional_text(const CLI::Option& option) {
    const bool several = option.get_items_expected_max() > 1;
    const std::string text = option.get_name() + (several ? "..." : "");
    return option.get_required() ? text : "[" + text + "]";
}

/// \param common footer of commands without one of their own
CommandRow command_row(const CLI::App& command, const std::string& common) {
    CommandRow row{.name = command.get_name(),
                   .summary = command.get_description(),
                   .positionals = {},
                   .options = {},
                   .footer = command.get_footer() == common ? "" : command.get_footer()};
    for (const CLI::Option* option : command.get_options()) {
        if (!is_listed(*option)) continue;
        if (option->get_positional()) {
            row.positionals.push_back(positional_text(*option));
            row.takes_operation |= option->get_name() == "OPERATION";
        } else if (!option->get_lnames().empty()) {
            row.options.push_back(option_row(*option));
        }
    }
    return row;
}

}  // namespace

std::vector<CommandRow> command_rows(const CLI::App& app) {
    std::vector<CommandRow> rows;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (is_listed(*command)) rows.push_back(command_row(*command, app.get_footer()));
    return rows;
}

std::vector<std::string> parameter_words(const Operation& operation) {
    std::vector<std::string> words;
    for (const Parameter& parameter : operation.parameters)
        if (parameter.use != Use::Decision) words.push_back(parameter.name + "=");
    return words;
}

std::vector<std::string> setting_words(std::span<const Operation> operations) {
    std::vector<std::string> words;
    for (const Operation& operation : operations)
        for (const std::string& parameter : parameter_words(operation))
            words.push_back(operation.name + "." + parameter);
    return words;
}

}  // namespace vesselbench
