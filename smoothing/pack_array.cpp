#include "smoothing/pack_array.h"

#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace vesselbench::detail {

namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

}  // namespace

PackArray::PackArray(std::size_t count) {
    const std::size_t bytes = count * sizeof(Pack);
    // Small arrays must not cost a whole large page.
    const std::size_t page = bytes >= kLargePage ? kLargePage : 64;
    const std::size_t rounded = (bytes + page) / page * page;
    void* memory = std::aligned_alloc(page, rounded);
    if (memory == nullptr) throw std::bad_alloc();
    memory_.reset(static_cast<double*>(memory));
    if (page == kLargePage) madvise(memory, rounded, MADV_HUGEPAGE);  // advice: may be ignored
}

void PackArray::Free::operator()(double* memory) const {
    std::free(memory);
}

}  // namespace vesselbench::detail
