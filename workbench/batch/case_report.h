#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace vesselbench {

/// A figure of a batch's table.
struct TableFigure {
    std::string name;     ///< of the column and in JSON; ends in its unit
    std::string title;    ///< in the page, where the unit follows
    std::string unit;     ///< empty: none
    std::string pointer;  ///< where report.json has it; of a list, its length counts
    int digits = 0;       ///< after the point, in the page
};

[[nodiscard]] std::span<const TableFigure> table_figures();

/// report.json of a case that has its model; null: it has none, or the file cannot be read.
[[nodiscard]] nlohmann::ordered_json read_report(const std::filesystem::path& folder);

/// The figure in a report; null: it has none.
[[nodiscard]] nlohmann::ordered_json figure_in(const nlohmann::ordered_json& report,
                                               const TableFigure& figure);

/// All bytes of a file in a case's folder; empty: there is none, or it cannot be read.
[[nodiscard]] std::string content_if_any(const std::filesystem::path& file);

/// The review of the case's project at this moment, in a few words: "not reviewed", review_words(),
/// or why it is not known.
[[nodiscard]] std::string review_state(const std::filesystem::path& folder,
                                       const std::string& purpose);

}  // namespace vesselbench
