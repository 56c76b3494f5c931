#pragma once

namespace vesselbench {

/// \throw InvalidInput unless minimum <= value <= maximum; the text names the parameter
void require_range(const char* name, double value, double minimum, double maximum);

/// \throw InvalidInput unless the value is positive and finite; the text names the parameter
void require_positive(const char* name, double value);

}  // namespace vesselbench
