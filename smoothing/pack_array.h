#pragma once

#include <cstddef>
#include <memory>

#include "smoothing/linear_step.h"

namespace vesselbench::detail {

/// Memory for packs, in large pages where the system has them; made without filling it, as the
/// first step does that.
class PackArray {
public:
    PackArray() = default;
    explicit PackArray(std::size_t count);

    [[nodiscard]] Pack* data() const { return reinterpret_cast<Pack*>(memory_.get()); }

private:
    struct Free {
        void operator()(double* memory) const;
    };

    std::unique_ptr<double[], Free> memory_;
};

}  // namespace vesselbench::detail
