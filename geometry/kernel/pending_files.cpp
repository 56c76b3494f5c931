#include "geometry/kernel/pending_files.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

[[noreturn]] void cannot_write(const fs::path& path, int cause) {
    std::string text = "'" + bare_name(path) + "' cannot be written";
    std::error_code ignored;
    if (cause == ENOENT && !fs::exists(folder_of(path), ignored))
        throw IoError(text + ": its folder '" + bare_name(folder_of(path)) + "' does not exist");
    if (cause != 0) text += std::string(": ") + std::strerror(cause);
    if (cause == ENOSPC) text += "; free some space or choose another folder";
    if (cause == EFBIG) text += "; raise the limit on the size of files (ulimit -f)";
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

void rename_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (fs::is_directory(to, error) && fs::is_directory(from, error)) fs::remove_all(to, error);
    fs::rename(from, to, error);
    if (error) cannot_write(to, error.value());
}

void remove_file(const fs::path& file) {
    std::error_code error;
    fs::remove(file, error);
    if (error) cannot_write(file, error.value());
}

void rename_to_free_name(const fs::path& from, const fs::path& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
    std::error_code ignored;
    if (errno == EEXIST || fs::exists(to, ignored))
        throw IoError(bare_name(to) + " already exists; choose another name or remove it first");
    rename_over(from, to);  // not every file system can refuse to replace
}

const std::string kPartial = ".partial-";

/// The process in a temporary folder's name; 0 if it is none.
pid_t process_of(const std::string& name) {
    pid_t process = 0;
    const char* const begin = name.data() + kPartial.size();
    const auto [end, error] = std::from_chars(begin, name.data() + name.size(), process);
    return error == std::errc{} && *end == '-' ? process : 0;
}

/// True if nobody writes to the folder any more: its process has ended, and no process, of another
/// machine or container either, holds its lock.
bool is_abandoned(const fs::path& folder) {
    const pid_t process = process_of(folder.filename().string());
    if (process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH) return false;
    const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock < 0) return false;

    struct stat info {};

    const bool own = ::fstat(lock, &info) == 0 && info.st_uid == ::geteuid();
    const bool abandoned = own && ::flock(lock, LOCK_EX | LOCK_NB) == 0;
    ::close(lock);
    return abandoned;
}

}  // namespace

void remove_abandoned(const fs::path& parent) {
    std::error_code ignored;
    std::vector<fs::path> abandoned;
    for (fs::directory_iterator at(parent, ignored), end; !ignored && at != end;
         at.increment(ignored))
        if (at->path().filename().string().starts_with(kPartial) && is_abandoned(at->path()))
            abandoned.push_back(at->path());
    for (const fs::path& folder : abandoned) fs::remove_all(folder, ignored);
}

PendingFiles::PendingFiles() = default;

PendingFiles::~PendingFiles() {
    remove_folders();
}

void PendingFiles::remove_folders() {
    std::error_code ignored;
    for (const TemporaryFolder& folder : folders_) {
        fs::remove_all(folder.path, ignored);
        if (folder.lock >= 0) ::close(folder.lock);
    }
    folders_.clear();
}

fs::path PendingFiles::folder_beside(const fs::path& final_name) {
    const fs::path parent = folder_of(final_name);
    for (const TemporaryFolder& folder : folders_)
        if (folder.parent == parent) return folder.path;
    remove_abandoned(parent);
    std::string name = (parent / (kPartial + std::to_string(::getpid()) + "-XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) cannot_write(final_name, errno);
    const int lock = ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (lock >= 0) ::flock(lock, LOCK_EX | LOCK_NB);
    folders_.push_back({parent, name, lock});
    return name;
}

fs::path PendingFiles::add(const fs::path& final_name) {
    files_.emplace_back(folder_beside(final_name) / final_name.filename(), final_name);
    return files_.back().first;
}

fs::path PendingFiles::add_stream(const fs::path& final_name,
                                  const std::function<void(std::ostream&)>& write) {
    fs::path temporary = add(final_name);
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (stream) write(stream);
    stream.close();
    if (!stream) cannot_write(final_name, errno);
    return temporary;
}

fs::path PendingFiles::add_text(const fs::path& final_name, const std::string& text) {
    return add_stream(final_name, [&](std::ostream& out) { out << text; });
}

void PendingFiles::add_mark(const fs::path& final_name, const std::string& text) {
    add_text(final_name, text);
    marks_.push_back(std::move(files_.back()));
    files_.pop_back();
}

void PendingFiles::flush_parents() const {
    for (const TemporaryFolder& folder : folders_) flush_to_disk(folder.parent, folder.parent);
}

void PendingFiles::commit(Existing existing) {
    for (const Names* names : {&files_, &marks_})
        for (const auto& [temporary, own] : *names) flush_to_disk(temporary, own);
    if (existing == Existing::Replace && !marks_.empty()) {
        for (auto mark = marks_.rbegin(); mark != marks_.rend(); ++mark) remove_file(mark->second);
        flush_parents();
    }
    for (Names* names : {&files_, &marks_}) {
        if (names->empty()) continue;
        for (const auto& [temporary, own] : *names)
            existing == Existing::Keep ? rename_to_free_name(temporary, own)
                                       : rename_over(temporary, own);
        flush_parents();
        names->clear();
    }
    remove_folders();
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
