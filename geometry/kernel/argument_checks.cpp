#include "geometry/kernel/argument_checks.h"

#include <cmath>
#include <sstream>

#include "geometry/kernel/errors.h"

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

}  // namespace vesselbench
