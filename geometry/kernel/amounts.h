#pragma once

#include <cstdint>
#include <string>

namespace vesselbench {

/// A time as people say it, in the unit that keeps it short: "0.4 s", "45 s", "12 min", "3.5 h".
/// \param seconds at least 0
[[nodiscard]] std::string duration_text(double seconds);

/// An amount of memory or of disk in binary units: "980 B", "3.2 MiB", "128 GiB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// The same of an amount in MiB.
[[nodiscard]] std::string mebibytes_text(double mebibytes);

}  // namespace vesselbench
