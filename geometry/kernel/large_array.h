#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace vesselbench {

/// A fixed array of plain values for passes over whole surfaces, aligned to a cache line.
/// Uninitialised: its first writer fills it on all threads.
template <class T>
class LargeArray {
    static constexpr std::align_val_t kAlignment{64};
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

public:
    LargeArray() = default;

    /// \throw std::bad_alloc
    explicit LargeArray(std::size_t size)
        : memory_(static_cast<T*>(::operator new(size * sizeof(T), kAlignment))), size_(size) {}

    [[nodiscard]] T* data() const { return memory_.get(); }

    [[nodiscard]] std::size_t size() const { return size_; }

    [[nodiscard]] T& operator[](std::size_t i) const { return memory_.get()[i]; }

private:
    struct Free {
        void operator()(T* memory) const { ::operator delete(memory, kAlignment); }
    };

    std::unique_ptr<T, Free> memory_;
    std::size_t size_ = 0;
};

}  // namespace vesselbench
