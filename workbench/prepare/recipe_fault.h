#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"

namespace vesselbench {

/// Something in a recipe that cannot be followed.
struct RecipeFault {
    std::string place;  ///< keys and indices that lead to it: "/2/arguments/lambda"
    std::string text;
    std::size_t line = 0;  ///< in the recipe's text, from 1 on; 0: unknown
};

using RecipeFaults = std::vector<RecipeFault>;

/// Runs a part of reading; what that throws becomes a fault at a place.
/// \return false: there was a fault
template <class Read>
bool note_faults(RecipeFaults& faults, const std::string& place, Read read) {
    try {
        read();
        return true;
    } catch (const UsageError& error) {
        faults.push_back({place, error.what()});
    } catch (const InvalidInput& error) {
        faults.push_back({place, error.what()});
    }
    return false;
}

}  // namespace vesselbench
