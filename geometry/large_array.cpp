#include "geometry/large_array.h"

#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace vesselbench::detail {

void FreeMemory::operator()(void* memory) const {
    std::free(memory);
}

void* large_memory(std::size_t bytes) {
    constexpr std::size_t kLargePage = std::size_t{2} << 20;
    // Small arrays must not cost a whole large page.
    const std::size_t page = bytes >= kLargePage ? kLargePage : 64;
    const std::size_t rounded = (bytes + page - 1) / page * page;
    void* memory = std::aligned_alloc(page, rounded > 0 ? rounded : page);
    if (memory == nullptr) throw std::bad_alloc();
    if (page == kLargePage) madvise(memory, rounded, MADV_HUGEPAGE);  // advice: may be ignored
    return memory;
}

}  // namespace vesselbench::detail
