#include "workbench/worker/input_files.h"

#include <algorithm>

#include "geometry/kernel/label_table_places.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

bool is_detached_header(const fs::path& path) {
    const std::string suffix = lower_case(path.extension().string());
    return suffix == ".mhd" || suffix == ".nhdr";
}

/// Bytes of the regular files in a folder and its folders.
std::uintmax_t folder_size(const fs::path& folder) {
    std::error_code error;
    std::uintmax_t size = 0;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
        std::error_code ignored;
        if (at->is_regular_file(ignored)) size += at->file_size(ignored);
    }
    return size;
}

/// The content of an input file [bytes], as far as its size tells. A mask compresses to less than a
/// hundredth, so that an image may hold more than its file, up to the size of a large mask.
std::uintmax_t content_size(const fs::path& path) {
    constexpr std::uintmax_t kMaskRatio = 128, kLargestMask = std::uintmax_t{256} << 20;
    std::error_code error;
    if (fs::is_directory(path, error)) return folder_size(path);
    if (is_detached_header(path)) return folder_size(fs::absolute(path).parent_path());
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return 0;
    const std::string suffix = lower_case(path.extension().string());
    const bool image = suffix == ".gz" || suffix == ".nrrd" || suffix == ".mha" || suffix == ".vti";
    return image ? size + std::min(kMaskRatio * size, kLargestMask) : size;
}

/// The values of the given arguments of type File.
std::vector<std::string> files_in(const Operation& operation, const Arguments& arguments) {
    std::vector<std::string> files;
    for (const Parameter& parameter : operation.parameters)
        if (parameter.type == ParameterType::File && arguments.has(parameter.name))
            files.push_back(arguments.text(parameter.name));
    return files;
}

}  // namespace

std::optional<std::uint64_t> reader_memory(const Operation& operation, const Arguments& arguments) {
    constexpr std::uint64_t kPerByte = 16, kBase = std::uint64_t{256} << 20;
    std::optional<std::uint64_t> bytes;
    for (const std::string& file : files_in(operation, arguments))
        bytes = bytes.value_or(kBase) + kPerByte * content_size(file);
    return bytes;
}

std::optional<std::string> file_read_by(const Operation& operation, const Arguments& arguments) {
    const std::vector<std::string> files = files_in(operation, arguments);
    if (files.empty()) return std::nullopt;
    const std::string& path = files.front();
    return path.substr(path.find_last_of('/', path.size() - 2) + 1);
}

std::vector<fs::path> places_read_by(const Operation& operation, const Arguments& arguments) {
    std::vector<fs::path> places;
    for (const fs::path file : files_in(operation, arguments)) {
        places.push_back(file);
        if (is_detached_header(file)) places.push_back(fs::absolute(file).parent_path());
        std::error_code ignored;
        for (const fs::path& table : label_table_places(file))
            if (fs::is_regular_file(table, ignored)) places.push_back(table);
    }
    return places;
}

}  // namespace vesselbench
