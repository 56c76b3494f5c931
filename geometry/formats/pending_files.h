#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace vesselbench {

/// Files and folders that appear under their own names only when all of them are complete. Until
/// commit() they are written to a temporary folder beside them; what is not committed is removed.
class PendingFiles {
public:
    PendingFiles() = default;
    ~PendingFiles();
    PendingFiles(const PendingFiles&) = delete;
    PendingFiles& operator=(const PendingFiles&) = delete;

    /// Where to write what will be `final_name`: the same file name in a temporary folder.
    /// \throw IoError if that folder cannot be made
    [[nodiscard]] std::filesystem::path add(const std::filesystem::path& final_name);

    /// Adds a text file. \throw IoError if it cannot be written entirely
    void add_text(const std::filesystem::path& final_name, const std::string& text);

    /// Flushes all of them to the disk and gives them their own names, replacing what was there.
    /// \throw IoError that names the file and the cause
    void commit();

private:
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> files_;  // temporary, own
};

/// Makes the folder and its parents. \throw IoError if it cannot be made or written to
void make_folder(const std::filesystem::path& folder);

/// Reads a whole text file. \throw IoError
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file);

}  // namespace vesselbench
