#include "geometry/kernel/pending_files.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, int cause) {
    std::string text = "'" + bare_name(path) + "' cannot be written";
    if (cause != 0) text += std::string(": ") + std::strerror(cause);
    if (cause == ENOSPC || cause == EFBIG) text += "; free some space or choose another folder";
    throw IoError(text);
}

/// Flushes a file or folder to the disk; if it cannot be opened, that is left to the system.
void flush_to_disk(const fs::path& path, const fs::path& shown) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const bool kept = ::fsync(file) == 0;
    const int cause = errno;
    ::close(file);
    if (!kept && (cause == ENOSPC || cause == EIO || cause == EDQUOT)) cannot_write(shown, cause);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

void rename_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (fs::is_directory(to, error) && fs::is_directory(from, error)) fs::remove_all(to, error);
    fs::rename(from, to, error);
    if (error) cannot_write(to, error.value());
}

void rename_to_free_name(const fs::path& from, const fs::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
    std::error_code ignored;
    if (errno == EEXIST || fs::exists(to, ignored))
        throw IoError(bare_name(to) + " already exists; choose another name or remove it first");
    rename_over(from, to);  // not every file system can refuse to replace
}

}  // namespace

PendingFiles::PendingFiles() {
    static std::atomic<int> count = 0;
    folder_name_ = ".partial-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
}

PendingFiles::~PendingFiles() {
    std::error_code ignored;
    for (const auto& [temporary, own] : files_) fs::remove_all(temporary.parent_path(), ignored);
}

fs::path PendingFiles::add(const fs::path& final_name) {
    const fs::path folder = folder_of(final_name) / folder_name_;
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) cannot_write(final_name, error.value());
    files_.emplace_back(folder / final_name.filename(), final_name);
    return files_.back().first;
}

void PendingFiles::add_stream(const fs::path& final_name,
                              const std::function<void(std::ostream&)>& write) {
    const fs::path temporary = add(final_name);
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (stream) write(stream);
    stream.close();
    if (!stream) cannot_write(final_name, errno);
}

void PendingFiles::add_text(const fs::path& final_name, const std::string& text) {
    add_stream(final_name, [&](std::ostream& out) { out << text; });
}

void PendingFiles::commit(Existing existing) {
    for (const auto& [temporary, own] : files_) flush_to_disk(temporary, own);
    for (const auto& [temporary, own] : files_)
        existing == Existing::Keep ? rename_to_free_name(temporary, own)
                                   : rename_over(temporary, own);
    std::error_code ignored;
    for (const auto& [temporary, own] : files_) {
        flush_to_disk(folder_of(own), own);
        fs::remove_all(temporary.parent_path(), ignored);
    }
    files_.clear();
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
        throw IoError("the folder '" + folder.filename().string() + "' cannot be created: " +
                      (error ? error.message() : std::string("a file with this name exists")));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw IoError("the folder '" + folder.filename().string() +
                      "' cannot be written to: " + std::strerror(errno));
}

}  // namespace vesselbench
