#pragma once

#include <charconv>
#include <string>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// The shortest text that reads back to the same number.
inline std::string number_text(double value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

inline std::string numbers_text(const Vec3& p) {
    return number_text(p.x()) + " " + number_text(p.y()) + " " + number_text(p.z());
}

}  // namespace vesselbench
