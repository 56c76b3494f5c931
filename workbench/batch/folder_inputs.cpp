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

/// Of what cannot be told, such as a link to itself: none.
fs::file_type file_type_of(const fs::path& path) {
    std::error_code error;
    return fs::status(path, error).type();
}

bool is_slice(const fs::path& file) {
    const ImageFormat* format = row_that_reads(image_formats(), file.string());
    return format != nullptr && !format->folder.empty();
}

bool is_input_folder(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    return file_type_of(folder / kCaseFile) == fs::file_type::regular ||
           std::ranges::any_of(entries, [](const fs::path& path) {
               return file_type_of(path) == fs::file_type::regular && is_slice(path);
           });
}

bool is_input(const fs::path& path) {
    if (file_type_of(path) == fs::file_type::directory) return is_input_folder(path);
    return file_type_of(path) == fs::file_type::regular &&
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
