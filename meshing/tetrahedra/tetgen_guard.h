#pragma once

namespace vesselbench {

/// Always true. Calling it makes the linker pull the guard's object from the static library, and
/// with it the terminatetetgen() that only throws.
[[nodiscard]] bool tetgen_guard_is_linked();

}  // namespace vesselbench
