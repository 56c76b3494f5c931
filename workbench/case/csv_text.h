#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vesselbench {

/// A record of a table in CSV.
struct CsvRecord {
    std::size_t line = 1;  ///< that it begins in
    std::vector<std::string> fields;
};

/// Reads CSV (RFC 4180): fields separated by commas, in quotes where they hold commas, quotes or
/// line breaks. Lines may end with LF alone, and the text may begin with a byte order mark. Empty
/// lines are no records.
/// \throw InvalidInput that names the line if a quote is open or amid a field, or the text is not
/// UTF-8
[[nodiscard]] std::vector<CsvRecord> csv_records(std::string_view text);

/// A field in quotes, whatever it holds.
[[nodiscard]] std::string csv_quoted(const std::string& field);

}  // namespace vesselbench
