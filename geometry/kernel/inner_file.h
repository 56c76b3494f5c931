#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// A file that a header or a description names, relative to the folder that this lies in, or an
/// entry of a folder: a file from a stranger must not lead to the user's other files.
/// \param folder of the naming file, or of the entry; empty: the current one
/// \param named as written there
/// \param what is named so, for the error text: "its image"
/// \return `named` in `folder`; it need not exist
/// \throw InvalidInput that names the other place, unless the file is inside the folder after links
/// are resolved
[[nodiscard]] std::filesystem::path inner_file(const std::filesystem::path& folder,
                                               const std::filesystem::path& named,
                                               const std::string& what);

}  // namespace vesselbench
