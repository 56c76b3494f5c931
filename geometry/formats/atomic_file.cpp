#include "geometry/formats/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include "geometry/formats/raw_surface.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// A name that is removed again unless it was renamed.
class TemporaryName {
public:
    explicit TemporaryName(std::string path) : path_(std::move(path)) {}

    TemporaryName(const TemporaryName&) = delete;
    TemporaryName& operator=(const TemporaryName&) = delete;

    ~TemporaryName() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove(path_, ignored);
    }

    [[nodiscard]] const std::string& path() const { return path_; }

    void keep() { path_.clear(); }

private:
    std::string path_;
};

[[noreturn]] void fail(const std::string& path, const char* what) {
    const int code = errno;
    std::string text = std::string(what) + " " + bare_name(path);
    if (code != 0) text += std::string(": ") + std::strerror(code);
    if (code == ENOSPC) text += "; free some space or choose another folder";
    throw IoError(text);
}

/// The data reach the disk before the name does.
bool synchronised(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY);
    if (file < 0) return false;
    const bool done = ::fsync(file) == 0;
    const int code = errno;
    ::close(file);
    errno = code;
    return done;
}

}  // namespace

void write_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
    TemporaryName temporary(path + ".part" + std::to_string(::getpid()));
    errno = 0;
    std::ofstream file(temporary.path(), std::ios::binary | std::ios::trunc);
    if (!file) fail(path, "cannot write");
    write(file);
    file.close();
    if (!file) fail(path, "cannot finish writing");
    if (!synchronised(temporary.path())) fail(path, "cannot finish writing");
    if (std::rename(temporary.path().c_str(), path.c_str()) != 0) fail(path, "cannot write");
    temporary.keep();
}

}  // namespace vesselbench
