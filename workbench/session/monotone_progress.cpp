#include "workbench/session/monotone_progress.h"

#include <atomic>
#include <memory>
#include <utility>

namespace vesselbench {

Progress::Receiver monotone(Progress::Receiver receiver) {
    const auto reached = std::make_shared<std::atomic<double>>(0.0);
    return [reached, receiver = std::move(receiver)](double fraction, std::string_view what) {
        double before = reached->load();
        while (before < fraction && !reached->compare_exchange_weak(before, fraction)) {
        }
        receiver(reached->load(), what);
    };
}

}  // namespace vesselbench
