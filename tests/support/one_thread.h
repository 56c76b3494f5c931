#pragma once

#if defined(__SANITIZE_THREAD__)
#include <tbb/global_control.h>

namespace vesselbench::test {

/// oneTBB is not instrumented: what it synchronizes looks like a race. Our own threads are tested.
const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace vesselbench::test
#endif
