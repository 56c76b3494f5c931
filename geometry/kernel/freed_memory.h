#pragma once

namespace vesselbench {

/// Returns to the system freed memory that the C library caches. For operations on whole surfaces,
/// between phases that allocate different containers.
void release_freed_memory() noexcept;

}  // namespace vesselbench
