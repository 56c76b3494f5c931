#include "workbench/window/features/history/thumbnail_files.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 200;

/// FNV-1a: names of files need no stronger hash.
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char letter : text)
        hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
    return hash;
}

void delete_oldest(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files.emplace_back(entry.last_write_time(), entry.path());
    if (files.size() <= kMostFiles) return;
    std::ranges::sort(files);
    std::error_code ignored;
    for (std::size_t i = 0; i + kMostFiles < files.size(); ++i)
        fs::remove(files[i].second, ignored);
}

}  // namespace

fs::path thumbnail_file(const fs::path& cache, const fs::path& project) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(project, error);
    const std::uint64_t hash = hash_of((error ? project : whole).string());
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.png", static_cast<unsigned long long>(hash));
    return cache / "thumbnails" / name;
}

void save_thumbnail(const fs::path& cache, const fs::path& project, const ClearPicture& picture) {
    try {
        const fs::path file = thumbnail_file(cache, project);
        fs::create_directories(file.parent_path());
        fs::permissions(file.parent_path(), fs::perms::owner_all);
        write_file(file, png(picture));
        delete_oldest(file.parent_path());
    } catch (const std::exception&) {  // see the header
    }
}

std::optional<ClearPicture> saved_thumbnail(const fs::path& cache, const fs::path& project) {
    const fs::path file = thumbnail_file(cache, project);
    std::error_code error;
    if (!fs::exists(file, error)) return std::nullopt;
    try {
        return picture_from_png(file_content(file));
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace vesselbench
