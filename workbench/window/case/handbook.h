#pragma once

#include <filesystem>
#include <string>

namespace vesselbench {

/// The start page of the packaged pages (docs/, as scripts/docs makes a site of them): of an
/// installation, or of the sources if it was made there; empty: there is none.
[[nodiscard]] std::filesystem::path handbook_page();

/// The page's address, with the answers to a search. \param words searched for; empty: none
[[nodiscard]] std::string handbook_address(const std::filesystem::path& page,
                                           const std::string& words);

/// Shows the page in the desktop's browser, which outlives the program. Words are searched for by a
/// page in the cache folder that leads there, since desktops open files, without what follows '?'.
/// \return false: there is no display, or no xdg-open
/// \throw IoError if the cache folder cannot be written
bool show_handbook(const std::filesystem::path& page, const std::string& words);

}  // namespace vesselbench
