#pragma once

#include <filesystem>
#include <optional>

#include "workbench/flow/flow_record.h"

namespace vesselbench {

/// A solver's case that can be run, or whose results can be read.
struct FlowCase {
    std::filesystem::path folder;    ///< of the case
    std::filesystem::path prepared;  ///< the folder of `prepare` that it is in; empty: in none
    FlowRecord record;
};

/// The case in a folder: an exported one itself, or the product of a preparation.
/// \param place the folder, or the project of a preparation
/// \throw InvalidInput if there is none, or it is not as it was exported
[[nodiscard]] FlowCase find_flow_case(const std::filesystem::path& place);

/// The last time above 0 of a case, or of a part of it, that was written whole; none: it has none.
[[nodiscard]] std::optional<double> last_whole_time(const std::filesystem::path& folder);

/// Removes what a killed solver has left half-written: times above 0 that are not whole.
/// \throw IoError
void remove_broken_times(const std::filesystem::path& folder);

/// The name of a time's folder: "50".
[[nodiscard]] std::string time_name(double time);

}  // namespace vesselbench
