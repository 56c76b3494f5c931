#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// Arrays and objects inside each other. Code that walks through JSON calls itself for each level.
constexpr std::size_t kDeepestJson = 64;
/// [bytes] of recipes, cases and phantoms.
constexpr std::size_t kLargestJsonFile = std::size_t{16} << 20;
/// [bytes] of what the program itself stores or sends: the dabs of a long stroke.
constexpr std::size_t kLargestStoredJson = std::size_t{256} << 20;

/// What becomes of comments, // to the end of a line and /* */, in texts that people write.
enum class JsonComments { Refused, Ignored };

/// Parses JSON of any origin; the only way to do so.
/// \param name of the text in error texts
/// \throw InvalidInput that names the line and column, if the text is larger or deeper than allowed
/// or not JSON
[[nodiscard]] nlohmann::ordered_json json_from_text(std::string_view text, const std::string& name,
                                                    std::size_t largest = kLargestJsonFile,
                                                    JsonComments comments = JsonComments::Refused);

/// The text of a JSON file. \throw IoError if it cannot be read, InvalidInput if it is too large
[[nodiscard]] std::string json_file_text(const std::filesystem::path& file);

/// The JSON of a file. \throw as both
[[nodiscard]] nlohmann::ordered_json json_from_file(const std::filesystem::path& file,
                                                    JsonComments comments = JsonComments::Refused);

/// The same with every text as printable() shows it, for documents that people read.
[[nodiscard]] nlohmann::ordered_json printable_json(nlohmann::ordered_json json);

/// JSON as text, of any content: bytes that are no UTF-8, as file names may have, become the
/// replacement character.
/// \param indent blanks for each level; -1: all in one line
[[nodiscard]] std::string text_from_json(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace vesselbench
