#pragma once

#include <map>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace vesselbench {

/// A page of the build with its data, which cannot leave the elements they are in, whatever texts
/// they hold.
/// \param page review_page_bytes() or viewer_page_bytes()
/// \param blobs by name, as packed_text()
/// \throw DiagnosedFailure if the build has no such page
[[nodiscard]] std::string filled_page(std::span<const unsigned char> page,
                                      const nlohmann::ordered_json& manifest,
                                      const std::map<std::string, std::string>& blobs);

/// \throw DiagnosedFailure as filled_page(): before long work
void require_page(std::span<const unsigned char> page);

}  // namespace vesselbench
