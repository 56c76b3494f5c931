#include "workbench/window/panels/folder_listing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "geometry/formats/dicom.h"
#include "geometry/formats/image_formats.h"
#include "geometry/formats/surface_formats.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDicomHead = 132;  ///< bytes up to the mark of a DICOM file
constexpr int kDicomFiles = 5;           ///< that are looked at in a folder

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool has_suffix(const std::string& name, const std::vector<std::string>& suffixes) {
    const std::string small = lower(name);
    return suffixes.empty() ||
           std::ranges::any_of(suffixes, [&](const std::string& s) { return small.ends_with(s); });
}

/// 0 for what has no size, such as a broken link.
std::uintmax_t size_of(const fs::directory_entry& file) {
    std::error_code error;
    const std::uintmax_t bytes = file.file_size(error);
    return error ? 0 : bytes;
}

FolderEntry entry_of(const fs::directory_entry& file) {
    std::error_code ignored;
    FolderEntry entry{.name = file.path().filename().string(),
                      .folder = file.is_directory(ignored)};
    if (entry.folder)
        entry.openable_folder = fs::exists(file.path() / "case.json", ignored);
    else
        entry.bytes = size_of(file);
    return entry;
}

/// Slices often have names without a suffix.
bool is_dicom_file(const fs::path& file) {
    std::array<char, kDicomHead> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return is_dicom({head.data(), static_cast<std::size_t>(stream.gcount())});
}

bool comes_before(const FolderEntry& a, const FolderEntry& b) {
    if (a.folder != b.folder) return a.folder;
    return lower(a.name) < lower(b.name);
}

}  // namespace

std::vector<std::string> openable_suffixes() {
    std::vector<std::string> suffixes = {".vbench"};
    for (const std::string& suffix : read_suffixes(surface_formats())) suffixes.push_back(suffix);
    for (const std::string& suffix : read_suffixes(image_formats())) suffixes.push_back(suffix);
    std::ranges::sort(suffixes);
    const auto repeated = std::ranges::unique(suffixes);
    suffixes.erase(repeated.begin(), repeated.end());
    return suffixes;
}

FolderListing list_folder(const fs::path& folder, const std::vector<std::string>& suffixes,
                          const Progress& progress) {
    FolderListing listing{.folder = folder};
    std::error_code error;
    fs::directory_iterator files(folder, fs::directory_options::skip_permission_denied, error);
    int looked_at = 0;
    for (const fs::directory_iterator end; !error && files != end; files.increment(error)) {
        progress.check_cancelled();
        FolderEntry entry = entry_of(*files);
        if (entry.name.starts_with(".")) continue;
        // Neither a link that leads nowhere nor one into a closed folder is an error here.
        std::error_code ignored;
        if (!entry.folder && files->is_regular_file(ignored) && looked_at++ < kDicomFiles)
            listing.has_dicom = listing.has_dicom || is_dicom_file(files->path());
        if (entry.folder || has_suffix(entry.name, suffixes)) listing.entries.push_back(entry);
    }
    if (error)
        listing.error = "'" + folder.filename().string() + "' cannot be read: " + error.message();
    std::ranges::sort(listing.entries, comes_before);
    return listing;
}

}  // namespace vesselbench
