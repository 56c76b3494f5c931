#include "workbench/batch/folder_inputs.h"

#include <algorithm>

#include "geometry/formats/image_formats.h"
#include "geometry/formats/surface_formats.h"
#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "workbench/prepare/case_files.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// By name, so that all machines find the same order.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (!entry->path().filename().string().starts_with(".")) entries.push_back(entry->path());
    if (error)
        throw IoError("the folder '" + bare_name(folder) + "' cannot be read: " + error.message());
    std::ranges::sort(entries);
    return entries;
}

bool is_slice(const fs::path& file) {
    const ImageFormat* format = row_that_reads(image_formats(), file.string());
    return format != nullptr && !format->folder.empty();
}

bool is_input_folder(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    return fs::exists(folder / kCaseFile) || std::ranges::any_of(entries, [](const fs::path& path) {
               return fs::is_regular_file(path) && is_slice(path);
           });
}

bool is_input(const fs::path& path) {
    if (fs::is_directory(path)) return is_input_folder(path);
    return fs::is_regular_file(path) &&
           (row_that_reads(surface_formats(), path.string()) != nullptr ||
            row_that_reads(image_formats(), path.string()) != nullptr);
}

}  // namespace

std::vector<fs::path> inputs_in(const fs::path& folder,
                                const std::function<void(const std::string&)>& skipped) {
    std::vector<fs::path> inputs;
    for (const fs::path& path : entries_of(folder))
        if (is_input(path))
            inputs.push_back(path);
        else
            skipped(bare_name(path));
    return inputs;
}

}  // namespace vesselbench
