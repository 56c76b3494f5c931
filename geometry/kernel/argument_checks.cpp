#include "geometry/kernel/argument_checks.h"

#include <cmath>
#include <sstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

void require_range(const char* name, double value, double minimum, double maximum) {
    if (value >= minimum && value <= maximum) return;
    std::ostringstream text;
    text << name << " = " << value << " is not in [" << minimum << ", " << maximum << "]";
    throw InvalidInput(text.str());
}

void require_positive(const char* name, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    std::ostringstream text;
    text << name << " = " << value << " must be positive and finite";
    throw InvalidInput(text.str());
}

void require_in_proportion(const char* name, double length, const Surface& surface, double most) {
    const double extent = bounds(surface).diagonal();
    if (!(extent > 0.0) || length <= most * extent) return;
    throw AlgorithmFailure(name +
                           formatted(length, " = %.3g mm is out of proportion to the model") +
                           formatted(extent, ", which is %.3g mm across: ") +
                           formatted(most * extent, "give at most %.3g mm"));
}

}  // namespace vesselbench
