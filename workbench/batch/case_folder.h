#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// The folders of a batch.
struct BatchFolders {
    std::filesystem::path out;

    /// Of a case.
    [[nodiscard]] std::filesystem::path of(const std::string& name) const {
        return out / "cases" / name;
    }

    /// Of results that newer ones have taken the place of.
    [[nodiscard]] std::filesystem::path earlier() const { return out / "earlier"; }
};

/// Makes the folder of a case that is about to run: empty but for a mark that says so. What a
/// batch has finished in it is moved to folders.earlier(); what it has not is removed.
/// \return where the earlier results are; empty: there were none
/// \throw IoError if it cannot be written, or holds what is not of a batch
std::filesystem::path begin_case(const BatchFolders& folders, const std::string& name);

/// Removes the mark: the case has its record. So are the lock and the unfinished files that a
/// killed program left in the folder.
void end_case(const BatchFolders& folders, const std::string& name);

/// Removes the folder of a case that was cancelled, with its mark.
void drop_case(const BatchFolders& folders, const std::string& name);

}  // namespace vesselbench
