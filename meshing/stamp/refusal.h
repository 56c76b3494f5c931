#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

/// Ends an operation at a place, with what would help. \throw DiagnosedFailure
[[noreturn]] void refuse(const char* code, const char* operation, const Vec3& place,
                         std::map<std::string, double> figures, std::vector<Remedy> remedies);

/// No two walls can be made at the contact there: `stamp` may do it by hand. \throw
/// DiagnosedFailure
[[noreturn]] void refuse_parting(const Vec3& place);

}  // namespace vesselbench
