#include "geometry/formats/pending_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Asks the disk to keep a file or folder; what cannot be opened for it is left to the system.
void flush_to_disk(const fs::path& path, const std::string& shown) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const bool kept = ::fsync(file) == 0;
    const int cause = errno;
    ::close(file);
    if (!kept && (cause == ENOSPC || cause == EIO || cause == EDQUOT))
        throw IoError("'" + shown + "' cannot be written: " + std::strerror(cause));
}

void rename_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (fs::is_directory(to, error) && fs::is_directory(from, error)) fs::remove_all(to, error);
    fs::rename(from, to, error);
    if (error)
        throw IoError("'" + to.filename().string() + "' cannot be written: " + error.message());
}

}  // namespace

PendingFiles::~PendingFiles() {
    std::error_code ignored;
    for (const auto& [temporary, own] : files_) fs::remove_all(temporary.parent_path(), ignored);
}

fs::path PendingFiles::add(const fs::path& final_name) {
    const fs::path parent = final_name.has_parent_path() ? final_name.parent_path() : ".";
    const fs::path folder = parent / (".partial-" + std::to_string(::getpid()));
    std::error_code error;
    fs::create_directory(folder, error);
    if (error)
        throw IoError("'" + final_name.filename().string() +
                      "' cannot be written: " + error.message());
    files_.emplace_back(folder / final_name.filename(), final_name);
    return files_.back().first;
}

void PendingFiles::add_text(const fs::path& final_name, const std::string& text) {
    std::ofstream stream(add(final_name), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
        throw IoError("'" + final_name.filename().string() +
                      "' cannot be written: " + std::strerror(errno));
}

void PendingFiles::commit() {
    for (const auto& [temporary, own] : files_) flush_to_disk(temporary, own.filename().string());
    for (const auto& [temporary, own] : files_) rename_over(temporary, own);
    std::error_code ignored;
    for (const auto& [temporary, own] : files_) fs::remove_all(temporary.parent_path(), ignored);
    files_.clear();
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw IoError("the folder '" + folder.filename().string() + "' cannot be made: " +
                      (error ? error.message() : std::string("a file of this name is there")));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw IoError("the folder '" + folder.filename().string() +
                      "' cannot be written to: " + std::strerror(errno));
}

std::string read_text_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream.is_open() || stream.bad())
        throw IoError("'" + file.filename().string() + "' cannot be read: " + std::strerror(errno));
    return text;
}

}  // namespace vesselbench
