#pragma once

#include <string>
#include <utility>

namespace vesselbench {

/// Whether a context can still be trusted, shared by all copies of its Device. What failed once
/// stays failed: drivers report a reset only once, and commands build upon each other.
class DeviceHealth {
public:
    /// Only the first reason is kept.
    void fail(std::string why) {
        if (why_.empty()) why_ = std::move(why);
    }

    /// Why nothing that the device holds can be believed; empty: all is well.
    [[nodiscard]] const std::string& failure() const { return why_; }

private:
    std::string why_;
};

}  // namespace vesselbench
