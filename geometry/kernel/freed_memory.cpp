#include "geometry/kernel/freed_memory.h"

#include <malloc.h>

namespace vesselbench {

void release_freed_memory() noexcept {
    malloc_trim(0);
}

}  // namespace vesselbench
