#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "workbench/window/workplace/workplace.h"

namespace vesselbench::test {

/// Updates a workplace that no window draws, frame after frame. \return false if it is not done
/// within two minutes
inline bool update_until(Workplace& place, const std::function<bool()>& done) {
    using namespace std::chrono_literals;
    for (const auto end = std::chrono::steady_clock::now() + 120s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(2ms)) {
        place.update();
        if (done()) return true;
    }
    return false;
}

}  // namespace vesselbench::test
