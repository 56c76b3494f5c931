#pragma once

#include <cstddef>
#include <string>

namespace vesselbench {

/// Work handed to a device so far. Unlike times, these numbers do not depend on the machine.
struct DeviceCounts {
    std::size_t dispatches = 0;
    std::size_t barriers = 0;     ///< between dispatches: the next one waits for the last
    std::size_t allocations = 0;  ///< buffers, those that reads go through included
    std::size_t compiles = 0;     ///< programs
    std::size_t reads = 0;        ///< each waits for the device
    std::size_t uploaded = 0;     ///< [bytes]
    std::size_t read_back = 0;    ///< [bytes]
    std::size_t copied = 0;       ///< between buffers of the device, also to read them [bytes]
};

/// The work since an earlier look.
[[nodiscard]] DeviceCounts since(const DeviceCounts& before, const DeviceCounts& now);

/// "12 dispatches, 9 barriers, ...", for reports.
[[nodiscard]] std::string text_of(const DeviceCounts& counts);

}  // namespace vesselbench
