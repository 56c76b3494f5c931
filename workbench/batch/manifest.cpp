#include "workbench/batch/manifest.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/formats/format.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/regular_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/batch/folder_inputs.h"
#include "workbench/case/csv_text.h"
#include "workbench/case/near_names.h"
#include "workbench/export/flow_parameters.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kCase = "case";
constexpr const char* kInput = "input";
constexpr const char* kSettings = "set";
constexpr const char* kRecipe = "recipe";
constexpr char kBetweenValues = ';';

/// A column of the manifest.
struct Column {
    std::string name;
    std::optional<CaseOption> option;  ///< none: the case's name, its input, or a setting
};

std::string line_text(std::size_t line) {
    return "line " + std::to_string(line) + ": ";
}

std::string shown(const std::string& text) {
    return "'" + shortened(printable(text)) + "'";
}

/// "operation.parameter" of every operation, and of the flow, but for files: these have columns of
/// their own, or belong into a recipe.
const std::set<std::string>& known_settings() {
    static const std::set<std::string> names = [] {
        std::set<std::string> all;
        const auto add = [&](const std::string& of, const std::vector<Parameter>& parameters) {
            for (const Parameter& parameter : parameters)
                if (parameter.type != ParameterType::File) all.insert(of + "." + parameter.name);
        };
        for (const Operation& operation : operation_table())
            add(operation.name, operation.parameters);
        add("openfoam", flow_parameters());
        return all;
    }();
    return names;
}

[[noreturn]] void refuse_column(const std::string& name, std::size_t line,
                                const CaseColumns& columns) {
    std::vector<std::string> known = {kCase, kInput};
    for (const CaseOption& option : columns.options) known.push_back(option.name);
    const bool is_setting = name.find('.') != std::string::npos;
    const std::vector<std::string> settings(known_settings().begin(), known_settings().end());
    const bool semicolons = name.find(kBetweenValues) != std::string::npos;
    throw InvalidInput(line_text(line) + "there is no column " + shown(name) +
                       (semicolons   ? "; fields are separated by commas"
                        : is_setting ? did_you_mean(name, settings)
                                     : did_you_mean(name, known) + " (the columns are " +
                                           joined(known) + ", and operation.parameter)"));
}

Column column_of(const std::string& name, std::size_t line, const CaseColumns& columns) {
    if (name == kCase || name == kInput || known_settings().contains(name))
        return {name, std::nullopt};
    const auto option = std::ranges::find(columns.options, name, &CaseOption::name);
    if (option == columns.options.end()) refuse_column(name, line, columns);
    return {name, *option};
}

std::vector<Column> header_of(const CsvRecord& record, const CaseColumns& columns) {
    std::vector<Column> header;
    std::set<std::string> seen;
    for (const std::string& name : record.fields) {
        header.push_back(column_of(name, record.line, columns));
        if (!seen.insert(name).second)
            throw InvalidInput(line_text(record.line) + "there are two columns " + shown(name));
    }
    if (!seen.contains(kInput))
        throw InvalidInput(line_text(record.line) + "there is no column 'input'");
    return header;
}

std::vector<std::string> separated(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == kBetweenValues)
            parts.emplace_back();
        else
            parts.back() += c;
    std::erase(parts, "");
    return parts;
}

class ManifestReader {
public:
    ManifestReader(const fs::path& manifest, const CaseColumns& columns)
        : folder_(manifest.has_parent_path() ? manifest.parent_path() : "."), columns_(columns) {}

    std::vector<BatchCase> cases(const std::vector<CsvRecord>& records) {
        if (records.empty()) throw InvalidInput("it is empty: the first line names the columns");
        header_ = header_of(records.front(), columns_);
        std::vector<BatchCase> cases;
        for (std::size_t i = 1; i < records.size(); ++i) cases.push_back(case_of(records[i]));
        if (cases.empty()) throw InvalidInput("it has no case, only the names of the columns");
        return cases;
    }

private:
    BatchCase case_of(const CsvRecord& record) {
        if (record.fields.size() != header_.size())
            throw InvalidInput(line_text(record.line) + counted(record.fields.size(), "field") +
                               " where the first line has " + counted(header_.size(), "column"));
        BatchCase one{.name = {}, .input = {}, .values = {}, .line = record.line};
        for (std::size_t i = 0; i < header_.size(); ++i)
            if (!record.fields[i].empty()) add(one, header_[i], record.fields[i]);
        if (one.input.empty()) throw InvalidInput(line_text(record.line) + "it has no input");
        add_shared(one, record.fields);
        if (one.name.empty()) one.name = case_name_of(one.input);
        refuse_name(one);
        return one;
    }

    void add(BatchCase& one, const Column& column, const std::string& text) {
        if (column.name == kCase)
            one.name = text;
        else if (column.name == kInput)
            one.input = input_path(text);
        else if (!column.option)
            one.values.push_back({kSettings, column.name + "=" + text});
        else if (column.option->is_flag)
            add_flag(one, *column.option, text);
        else if (column.option->repeatable)
            for (const std::string& part : separated(text)) add_value(one, *column.option, part);
        else
            add_value(one, *column.option, text);
    }

    static void add_flag(BatchCase& one, const CaseOption& option, const std::string& text) {
        const std::string word = lower_case(text);
        if (word != "yes" && word != "no")
            throw InvalidInput(line_text(one.line) + option.name + " must be yes or no, not " +
                               shown(text));
        if (word == "yes")
            one.values.push_back({.option = option.name, .text = {}, .is_flag = true});
    }

    void add_value(BatchCase& one, const CaseOption& option, const std::string& text) const {
        const bool is_file = names_file(option, text);
        one.values.push_back({option.name, is_file ? (folder_ / text).string() : text, is_file});
    }

    /// What all cases are given comes first: of settings, the last one counts.
    void add_shared(BatchCase& one, const std::vector<std::string>& fields) const {
        const auto has_own = [&](const std::string& option) {
            for (std::size_t i = 0; i < header_.size(); ++i)
                if (header_[i].option && header_[i].name == option && !fields[i].empty())
                    return true;  // also where it is "no"
            return false;
        };
        std::vector<CaseValue> values;
        for (const CaseValue& value : columns_.shared)
            if (value.option == kSettings || !has_own(value.option)) values.push_back(value);
        one.values.insert(one.values.begin(), values.begin(), values.end());
    }

    [[nodiscard]] std::string input_path(const std::string& text) const {
        const fs::path beside = folder_ / text;
        return !file_exists(beside) && !bundled_case(text).empty() ? text : beside.string();
    }

    void refuse_name(const BatchCase& one) {
        const std::string place = line_text(one.line) + "the case's name " + shown(one.name);
        if (!is_plain_name(one.name) || one.name.starts_with("."))
            throw InvalidInput(place + " must be " + plain_name_rule() +
                               ", and not begin with a '.': its folder has that name");
        const auto [first, is_new] = lines_.emplace(one.name, one.line);
        if (!is_new)
            throw InvalidInput(place + " is that of line " + std::to_string(first->second) +
                               ", too: name the cases in a column 'case'");
    }

    fs::path folder_;
    const CaseColumns& columns_;
    std::vector<Column> header_;
    std::map<std::string, std::size_t> lines_;  // of the names
};

bool is_label_list(const std::string& text) {
    return text.find_first_not_of("0123456789,") == std::string::npos;
}

}  // namespace

bool names_file(const CaseOption& option, const std::string& text) {
    if (!option.is_file) return false;
    if (option.name == kRecipe) return !is_bundled_recipe(text);
    return !(option.repeatable && (is_label_list(text) || names_segment(text)));
}

std::string case_name_of(const fs::path& input) {
    const fs::path path = input.has_filename() ? input : input.parent_path();
    std::string name = path.filename().string();
    std::error_code ignored;
    if (!fs::is_directory(path, ignored))
        name.resize(name.size() - std::min(name.size(), lower_suffix(name).size()));
    name = PlainNames().add(name);
    return name.starts_with(".") ? "case" + name : name;
}

std::vector<BatchCase> cases_of_manifest(const fs::path& manifest, const CaseColumns& columns) {
    const std::string text = file_content(manifest);
    try {
        return ManifestReader(manifest, columns).cases(csv_records(text));
    } catch (const InvalidInput& error) {
        throw InvalidInput("'" + bare_name(manifest) + "', " + error.what());
    }
}

std::vector<BatchCase> cases_in_folder(const fs::path& folder, const CaseColumns& columns,
                                       const std::function<void(const std::string&)>& skipped) {
    const std::vector<fs::path> inputs = inputs_in(folder, skipped);
    if (inputs.empty())
        throw InvalidInput("'" + bare_name(folder) + "' has no surface, image or case in it");
    std::map<std::string, std::size_t> uses;
    for (const fs::path& input : inputs) ++uses[case_name_of(input)];
    PlainNames names;
    std::vector<BatchCase> cases;
    for (const fs::path& input : inputs) {
        std::string name = case_name_of(input);
        if (uses[name] > 1) name = input.filename().string();  // "a.stl" beside "a.ply"
        cases.push_back(
            {.name = names.add(name), .input = input.string(), .values = columns.shared});
    }
    return cases;
}

}  // namespace vesselbench
