#pragma once

#include <utility>

namespace vesselbench {

/// A point in the commands of a context, for which the contexts that share with it can wait. Made,
/// used and deleted while one of these contexts is current. Buffers that were written before it are
/// seen behind it once they are bound again.
class Fence {
public:
    /// Behind all commands of the current context so far, which it hands to the device.
    Fence();
    ~Fence();

    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}

    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }

    /// The current context's later commands run behind it. Does not wait itself.
    void order() const;

    /// True once the device is there. Does not wait.
    [[nodiscard]] bool reached() const;

private:
    void* sync_ = nullptr;
};

}  // namespace vesselbench
