#include "workbench/project/file_lock.h"

#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vesselbench {

namespace {

/// True if the path still names the opened file: its last holder may have removed it meanwhile.
bool still_there(int descriptor, const std::filesystem::path& path) {
    struct stat opened {};

    struct stat named {};

    return fstat(descriptor, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

/// Neither a device or pipe nor another name of a file that lies elsewhere: the lock is written to.
bool is_own_file(int descriptor) {
    struct stat opened {};

    return fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_nlink <= 1;
}

std::string holder(int descriptor) {
    std::array<char, 32> text{};
    const auto size = pread(descriptor, text.data(), text.size() - 1, 0);
    const std::string pid = text.data();
    const bool digits = pid.find_first_not_of("0123456789") == std::string::npos;
    return size > 0 && digits ? " (process " + pid + ")" : "";
}

void write_holder(int descriptor) {
    const std::string pid = std::to_string(getpid());
    // Only for the other process's error text; the lock holds without it.
    if (ftruncate(descriptor, 0) == 0 && pwrite(descriptor, pid.data(), pid.size(), 0) < 0) return;
}

}  // namespace

FileLock::Attempt FileLock::acquire(const std::filesystem::path& project) {
    std::filesystem::path path = project;
    path += "-lock";
    while (true) {
        const int descriptor =
            open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
        if (descriptor < 0 && errno == ELOOP)
            return {nullptr, path.filename().string() + " is a link: remove it"};
        if (descriptor < 0) return {nullptr, "its folder cannot be written"};
        if (!is_own_file(descriptor)) {
            close(descriptor);
            return {nullptr, path.filename().string() +
                                 " is not a regular file, or has another hard link: remove it"};
        }
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const std::string who = holder(descriptor);
            close(descriptor);
            return {nullptr, "another vesselbench" + who + " has it open"};
        }
        if (still_there(descriptor, path)) {
            write_holder(descriptor);
            return {std::unique_ptr<FileLock>(new FileLock(std::move(path), descriptor)), {}};
        }
        close(descriptor);
    }
}

FileLock::FileLock(std::filesystem::path path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

FileLock::~FileLock() {
    unlink(path_.c_str());
    close(descriptor_);
}

}  // namespace vesselbench
