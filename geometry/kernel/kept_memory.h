#pragma once

namespace vesselbench {

/// Gives the memory that large arrays keep for the next ones back to the system. For operations on
/// whole surfaces, where it would come on top of what other containers take.
void release_kept_memory() noexcept;

}  // namespace vesselbench
