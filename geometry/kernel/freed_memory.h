#pragma once

namespace vesselbench {

/// Gives memory that was freed, but that the C library keeps for later, back to the system. For
/// operations on whole surfaces, between phases that take their memory from different containers.
void release_freed_memory() noexcept;

}  // namespace vesselbench
