#pragma once

#include <filesystem>
#include <string>

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

/// Renames what an export of the purpose's products may not replace, such as the results of a flow.
void keep_earlier_products(const std::filesystem::path& folder, const std::string& purpose,
                           const Teller& tell);

/// Says which products of other purposes are in the folder: they are not of this model.
void name_other_products(const std::filesystem::path& folder, const std::string& purpose,
                         const Teller& tell);

}  // namespace vesselbench
