#include "geometry/kernel/large_array.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

#include <malloc.h>
#include <sys/mman.h>

namespace vesselbench::detail {

namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Small arrays must not cost a whole large page.
std::size_t rounded(std::size_t bytes) {
    const std::size_t page = bytes >= kLargePage ? kLargePage : 64;
    return std::max(page, (bytes + page - 1) / page * page);
}

/// Memory that was given back, for the next one who asks for about as much.
class KeptMemory {
public:
    /// Null if there is none; then what there is serves other surfaces than this one, and is freed.
    [[nodiscard]] void* take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        const auto found = std::ranges::find(blocks_, bytes, &Block::bytes);
        if (found == blocks_.end()) {
            shrink_to(0);
            return nullptr;
        }
        void* memory = found->memory;
        blocks_.erase(found);
        total_ -= bytes;
        return memory;
    }

    /// Frees the oldest blocks in return.
    void keep(void* memory, std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        blocks_.push_back({memory, bytes});
        total_ += bytes;
        shrink_to(kMost);
    }

    void free_all() {
        const std::lock_guard lock(mutex_);
        shrink_to(0);
    }

private:
    static constexpr std::size_t kMost = std::size_t{48} << 20;

    void shrink_to(std::size_t most) {
        for (; total_ > most; blocks_.erase(blocks_.begin())) {
            std::free(blocks_.front().memory);
            total_ -= blocks_.front().bytes;
        }
    }

    struct Block {
        void* memory;
        std::size_t bytes;
    };

    std::mutex mutex_;
    std::vector<Block> blocks_;  ///< oldest first
    std::size_t total_ = 0;
};

KeptMemory& kept() {
    static KeptMemory& memory = *new KeptMemory;  // outlives every array
    return memory;
}

}  // namespace

void* large_memory(std::size_t bytes) {
    const std::size_t size = rounded(bytes);
    if (size >= kLargePage)
        if (void* memory = kept().take(size)) return memory;
    void* memory = std::aligned_alloc(size >= kLargePage ? kLargePage : 64, size);
    if (memory == nullptr) throw std::bad_alloc();
    if (size >= kLargePage) madvise(memory, size, MADV_HUGEPAGE);  // advice: may be ignored
    return memory;
}

void give_back_large_memory(void* memory, std::size_t bytes) noexcept {
    const std::size_t size = rounded(bytes);
    if (size < kLargePage)
        std::free(memory);
    else if (memory != nullptr)
        kept().keep(memory, size);
}

}  // namespace vesselbench::detail

namespace vesselbench {

void release_kept_memory() noexcept {
    detail::kept().free_all();
    malloc_trim(0);  // freed arrays in the middle of the heap, too
}

}  // namespace vesselbench
