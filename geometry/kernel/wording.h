#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A place [mm] in error texts and warnings: "(12.346, -5.1, 1234.5) mm".
[[nodiscard]] std::string place_text(const Vec3& point);

/// The same without the unit, for lists of places: "(12.346, -5.1, 1234.5)".
[[nodiscard]] std::string coordinates_text(const Vec3& point);

/// The same as an argument that can be typed: "12.346,-5.1,1234.5".
[[nodiscard]] std::string coordinates_argument(const Vec3& point);

/// A number with its noun: "1 place", "3 places".
/// \param plural if it is not the noun with an s
[[nodiscard]] std::string counted(std::size_t count, const std::string& noun,
                                  const std::string& plural = "");

/// "a, b, c"
[[nodiscard]] std::string joined(std::span<const std::string> names,
                                 const std::string& separator = ", ");

/// "a, b and c", or with another last word "a, b or c".
[[nodiscard]] std::string enumerated(const std::vector<std::string>& words,
                                     const std::string& last = "and");

/// ASCII letters only; other bytes stay.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The text escaped for XML and HTML, also in attributes; control characters, which XML cannot
/// hold, and bytes that are no UTF-8 are shown as printable() does.
[[nodiscard]] std::string xml_escaped(const std::string& text);

/// A number in a printf format: formatted(0.1234) is "0.123".
/// \param format one conversion for a double
[[nodiscard]] std::string formatted(double value, const char* format = "%.3g");

/// A number as a user would type it: 3.00018 is 3.
[[nodiscard]] double three_digits(double value);

}  // namespace vesselbench
