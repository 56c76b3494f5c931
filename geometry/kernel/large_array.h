#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace vesselbench {

namespace detail {

/// Memory for `bytes`, aligned to 64 bytes or more; in large pages where the system has them and
/// the array fills some. Some of what was given back is kept and given out again: the system fills
/// new pages with zeros, which takes as long as an iteration of a filter for every few of them.
/// \throw std::bad_alloc
[[nodiscard]] void* large_memory(std::size_t bytes);

/// \param bytes as it was asked for
void give_back_large_memory(void* memory, std::size_t bytes) noexcept;

struct GiveBack {
    std::size_t bytes = 0;

    void operator()(void* memory) const { give_back_large_memory(memory, bytes); }
};

}  // namespace detail

/// Gives the memory that large arrays keep for the next ones back to the system. For operations on
/// whole surfaces, where it would come on top of what other containers take.
void release_kept_memory() noexcept;

/// A fixed array of plain values for passes over whole surfaces. It is not filled when it is made,
/// which its first writer does on all threads, and it lies in large pages: on big surfaces, filling
/// and small pages cost as much as some iterations of a filter.
template <class T>
class LargeArray {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

public:
    LargeArray() = default;

    explicit LargeArray(std::size_t size)
        : memory_(static_cast<T*>(detail::large_memory(size * sizeof(T))),
                  detail::GiveBack{size * sizeof(T)}),
          size_(size) {}

    [[nodiscard]] T* data() const { return memory_.get(); }

    [[nodiscard]] std::size_t size() const { return size_; }

    [[nodiscard]] T& operator[](std::size_t i) const { return memory_.get()[i]; }

private:
    std::unique_ptr<T, detail::GiveBack> memory_;
    std::size_t size_ = 0;
};

}  // namespace vesselbench
