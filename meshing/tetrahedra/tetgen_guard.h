#pragma once

namespace vesselbench {

/// True. A call makes the linker take the guard's object out of the static library, and with it the
/// terminatetetgen() that only throws.
[[nodiscard]] bool tetgen_guard_is_linked();

}  // namespace vesselbench
