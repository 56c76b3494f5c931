#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace vesselbench {

/// What happens to an existing file of the same name.
enum class Existing { Replace, Keep };

/// Files and folders that appear under their final names only when all of them are complete. Until
/// commit() they are written to a temporary folder beside them, of an unpredictable name;
/// uncommitted ones are removed. What a killed process left behind is removed by the next one that
/// writes there.
class PendingFiles {
public:
    PendingFiles();
    ~PendingFiles();
    PendingFiles(const PendingFiles&) = delete;
    PendingFiles& operator=(const PendingFiles&) = delete;

    /// The path for writing the future `final_name`: the same file name in a temporary folder.
    /// \throw IoError if that folder cannot be created
    [[nodiscard]] std::filesystem::path add(const std::filesystem::path& final_name);

    /// Adds a file that `write` fills.
    /// \return its path until commit()
    /// \throw IoError if it cannot be written entirely
    std::filesystem::path add_stream(const std::filesystem::path& final_name,
                                     const std::function<void(std::ostream&)>& write);

    /// Adds a text file, as add_stream().
    std::filesystem::path add_text(const std::filesystem::path& final_name,
                                   const std::string& text);

    /// Adds a text file that says that the others are complete: commit() removes earlier files of
    /// the marks' names, the last one first, before it replaces anything, and gives the marks their
    /// names at the end, in their order. Where the last one is, all files are of one commit,
    /// whenever a process was killed. \throw IoError if it cannot be written entirely
    void add_mark(const std::filesystem::path& final_name, const std::string& text);

    /// Flushes all of them to disk and gives them their final names.
    /// \throw IoError that names the file and the cause; with Existing::Keep also if one of the
    /// files already exists
    void commit(Existing existing = Existing::Replace);

private:
    struct TemporaryFolder {
        std::filesystem::path parent, path;
        int lock = -1;  // held for as long as the folder is in use
    };

    using Names = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;

    [[nodiscard]] std::filesystem::path folder_beside(const std::filesystem::path& final_name);
    void flush_parents() const;
    void remove_folders();

    std::vector<TemporaryFolder> folders_;
    Names files_, marks_;  // temporary, final
};

/// Removes the temporary folders that killed processes have left in a folder. Never throws.
void remove_abandoned(const std::filesystem::path& parent);

/// Creates the folder and its parents. \throw IoError if it cannot be created or written to
void make_folder(const std::filesystem::path& folder);

}  // namespace vesselbench
