#include "workbench/export/products.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/near_names.h"
#include "workbench/case/purposes.h"
#include "workbench/export/export_formats.h"
#include "workbench/export/flow_parameters.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// The flow as a row like those of the operation table, to share their checks and texts.
Operation openfoam() {
    return {.name = "openfoam", .parameters = flow_parameters()};
}

fs::path without_last_slash(const fs::path& file) {
    return file.has_filename() ? file : file.parent_path();
}

/// The row that writes a file of this name, or a null pointer.
const ExportFormat* format_of(const fs::path& file) {
    return row_that_writes(export_formats(), without_last_slash(file).string());
}

}  // namespace

CfdParameters take_flow_parameters(std::vector<std::string>& texts) {
    const Operation table = openfoam();
    const std::string prefix = table.name + ".";
    std::vector<std::string> own;
    for (const std::string& text : texts)
        if (text.starts_with(prefix)) own.push_back(text.substr(prefix.size()));
    std::erase_if(texts, [&](const std::string& text) { return text.starts_with(prefix); });
    return flow_from(checked_arguments(arguments_from_texts(table, own)));
}

std::vector<std::string> product_names(const std::string& purpose) {
    std::vector<std::string> names = {"surface.vtp", "surface.stl"};
    const std::vector<std::string>& own = find_purpose(purpose).products;
    names.insert(names.end(), own.begin(), own.end());
    return names;
}

std::vector<std::string> write_products(PendingFiles& files, const fs::path& folder,
                                        const Scene& scene, const std::string& purpose,
                                        const CfdParameters& flow) {
    const std::vector<std::string> names = product_names(purpose);
    for (const std::string& name : names) export_scene(files, folder / name, scene, flow);
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

void export_scene(PendingFiles& files, const fs::path& file, const Scene& scene,
                  const CfdParameters& flow) {
    check_export_name(file);
    format_of(file)->write(scene, files.add(without_last_slash(file)).string(), flow);
}

}  // namespace vesselbench
