#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace vesselbench {

/// The right to write a project: held by one process at a time, by a lock on a small file beside
/// it. It ends with the process, however that ends.
class FileLock {
public:
    /// The outcome of an attempt: a lock, or the reason why there is none.
    struct Attempt {
        std::unique_ptr<FileLock> lock;
        std::string reason;
    };

    /// Does not wait.
    [[nodiscard]] static Attempt acquire(const std::filesystem::path& project);

    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    FileLock(std::filesystem::path path, int descriptor);

    std::filesystem::path path_;
    int descriptor_;
};

}  // namespace vesselbench
