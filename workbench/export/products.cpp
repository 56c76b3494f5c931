#include "workbench/export/products.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/openfoam_case.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/arguments_json.h"
#include "workbench/case/json_text.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/export/flow_parameters.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// "." gets its name, and a last slash is left out.
fs::path without_last_slash(const fs::path& file) {
    const fs::path whole = fs::absolute(file).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

/// The suffixes of the formats that have a property.
std::string suffixes_with(bool ExportFormat::*property) {
    std::vector<std::string> suffixes;
    for (const ExportFormat& format : export_formats())
        if (format.*property)
            suffixes.insert(suffixes.end(), format.suffixes.begin(), format.suffixes.end());
    return joined(suffixes, " and ");
}

/// The row that writes a file of this name, or a null pointer.
const ExportFormat* format_of(const fs::path& file) {
    return row_that_writes(export_formats(), without_last_slash(file).string());
}

constexpr const char* kWaveform = "waveform";

/// \throw UsageError as kept_waveform()
void keep_waveform(Arguments& given) {
    if (given.has(kWaveform)) given.set(kWaveform, kept_waveform(given.text(kWaveform)));
}

}  // namespace

FlowSettings::FlowSettings(Arguments given) : given_(std::move(given)) {
    keep_waveform(given_);
    static_cast<void>(parameters());  // a text in them may be wrong
}

FlowSettings::FlowSettings(const std::string& stored) {
    if (stored.empty()) return;
    try {
        given_ = arguments_from_json(flow_table(), json_from_text(stored, "the stored flow"));
    } catch (const UsageError& error) {
        throw InvalidInput(std::string("the flow stored in the project: ") + error.what());
    }
}

void FlowSettings::take(std::vector<std::string>& texts) {
    const Operation& table = flow_table();
    const std::string prefix = table.name + ".";
    std::vector<std::string> own;
    for (const std::string& text : texts)
        if (text.starts_with(prefix)) own.push_back(text.substr(prefix.size()));
    std::erase_if(texts, [&](const std::string& text) { return text.starts_with(prefix); });
    const GivenArguments more = arguments_from_texts(table, own);
    for (const auto& [name, value] : more->values()) given_.set(name, value);
    keep_waveform(given_);
    static_cast<void>(parameters());  // a text in them may be wrong
}

CfdParameters FlowSettings::parameters() const {
    return flow_from(checked_arguments(flow_table(), given_));
}

std::string FlowSettings::text() const {
    Arguments shown = given_;
    if (shown.has(kWaveform) && !is_synthetic(shown.text(kWaveform)))
        shown.set(kWaveform, std::string("(numbers of a file)"));
    return argument_summary(flow_table(), shown);
}

std::string FlowSettings::stored() const {
    return given_.values().empty() ? "" : to_json(given_).dump();
}

std::vector<std::string> product_names(const std::string& purpose) {
    std::vector<std::string> names = {"surface.vtp", "surface.stl"};
    const std::vector<std::string>& own = find_purpose(purpose).products;
    names.insert(names.end(), own.begin(), own.end());
    return names;
}

void check_export_name(const fs::path& file) {
    if (format_of(file)) return;
    const std::string suffix = lower_suffix(without_last_slash(file).string());
    const std::vector<std::string> suffixes = written_suffixes(export_formats());
    throw UsageError("'" + file.filename().string() + "': there is no format for '" + suffix + "'" +
                     did_you_mean(suffix, suffixes) + " (there are " + joined(suffixes) + ", and " +
                     folder_text(export_formats()) + ")");
}

void check_takes_colour(const fs::path& file) {
    check_export_name(file);
    if (!format_of(file)->takes_colour)
        throw UsageError("--colour: " + format_of(file)->name + " files hold no colours; " +
                         suffixes_with(&ExportFormat::takes_colour) + " do");
}

void check_takes_page(const fs::path& file, const std::string& option) {
    check_export_name(file);
    if (!format_of(file)->takes_page)
        throw UsageError(option + " is for " + suffixes_with(&ExportFormat::takes_page) +
                         ", not for " + format_of(file)->name);
}

void check_export_place(const fs::path& file) {
    const fs::path place = without_last_slash(file);
    const ExportFormat* format = format_of(place);
    std::error_code error;
    if (format == nullptr || !fs::exists(place, error)) return;
    const bool folder = fs::is_directory(place, error);
    if (!folder && format->folder.empty()) return;
    if (folder && !format->folder.empty() &&
        (fs::is_empty(place, error) || is_unused_openfoam_case(place)))
        return;
    throw IoError("'" + place.filename().string() + "' " +
                  (folder ? "holds other files, or results of a flow" : "is a file") +
                  ": it is not replaced; give another name");
}

void export_scene(PendingFiles& files, const fs::path& file, const Scene& scene,
                  const ExportOptions& options, const Progress& progress) {
    check_export_name(file);
    check_export_place(file);
    format_of(file)->write(scene, files.add(without_last_slash(file)).string(), options, progress);
}

}  // namespace vesselbench
