#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vesselbench {

/// A ZIP archive of named parts, each deflated; no dates, so that the same parts give the same
/// bytes. Source: PKWARE APPNOTE 6.3, sections 4.3.7, 4.3.12, 4.3.16.
/// \throw InvalidInput if a part or the whole is 4 GiB or larger
[[nodiscard]] std::string zip_archive(
    const std::vector<std::pair<std::string, std::string>>& parts);

}  // namespace vesselbench
