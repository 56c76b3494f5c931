#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workbench/prepare/apply_recipe.h"

namespace vesselbench {

/// The folder that `prepare` writes to. One that it created is removed at the end if it is empty.
class ResultFolder {
public:
    /// \throw IoError if it cannot be created or written to
    explicit ResultFolder(std::filesystem::path path);
    ~ResultFolder();
    ResultFolder(const ResultFolder&) = delete;
    ResultFolder& operator=(const ResultFolder&) = delete;

private:
    std::filesystem::path path_;
    bool is_new_;
};

/// Renames a file or folder to the first free one of "project.1.vbench", "project.2.vbench" ...; a
/// project with its log.
/// \throw IoError if it cannot be renamed
void keep_earlier(const std::filesystem::path& file, const Teller& tell);

/// Names of the files and folders that a preparation for a purpose writes: products and reports.
/// \throw UsageError as find_purpose
[[nodiscard]] std::vector<std::string> result_names(const std::string& purpose);

/// Names of what earlier preparations wrote to the folder: its report.json lists them. Empty if
/// there is no such file, or it is not of `prepare`.
[[nodiscard]] std::vector<std::string> earlier_results(const std::filesystem::path& folder);

/// Renames, as keep_earlier(), what an export of these names may not replace, such as the results
/// of a flow.
void keep_irreplaceable(const std::filesystem::path& folder, const std::vector<std::string>& names,
                        const Teller& tell);

/// Renames, as keep_earlier(), what has these names and is no earlier result.
/// \param earlier earlier_results()
void keep_others(const std::filesystem::path& folder, const std::vector<std::string>& names,
                 const std::vector<std::string>& earlier, const Teller& tell);

/// The earlier results that remain beside new ones of these names.
[[nodiscard]] std::vector<std::string> remaining_results(const std::filesystem::path& folder,
                                                         const std::vector<std::string>& names,
                                                         const std::vector<std::string>& earlier);

}  // namespace vesselbench
