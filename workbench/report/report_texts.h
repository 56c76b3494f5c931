#pragma once

#include <initializer_list>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// Values of report.json as its page shows them.

/// Three significant digits, without an exponent between 0.001 and 1e9: "0.125", "1230"; 0 for a
/// rounding error of lengths and angles.
[[nodiscard]] std::string figure_text(double number);

/// A key of the document in words, its unit in brackets: "mean_velocity_m_s" is "mean velocity
/// [m/s]".
[[nodiscard]] std::string key_text(std::string key);

/// One value; "-": there is none. Long lists of numbers are left to report.json.
[[nodiscard]] std::string shown_text(const nlohmann::ordered_json& value);

/// A member of an object; null if there is none.
[[nodiscard]] const nlohmann::ordered_json& member_of(const nlohmann::ordered_json& json,
                                                      const std::string& key);

/// The values of some keys.
[[nodiscard]] nlohmann::ordered_json shown_texts(const nlohmann::ordered_json& json,
                                                 std::initializer_list<const char*> keys);

/// Each element of a list.
[[nodiscard]] nlohmann::ordered_json shown_texts(const nlohmann::ordered_json& list);

/// A place as an argument, to be copied: "1,2,31.5".
[[nodiscard]] std::string place_argument(const nlohmann::ordered_json& place);

/// The number of the vessel end that became an opening, as `vesselbench ends` numbers them; "-": it
/// has none.
[[nodiscard]] std::string end_number(const nlohmann::ordered_json& report,
                                     const nlohmann::ordered_json& opening);

}  // namespace vesselbench
