#pragma once

#include <string>

#include "gpu/picture.h"

namespace vesselbench {

/// The picture as a PNG file's bytes.
[[nodiscard]] std::string png(const Picture& picture);

}  // namespace vesselbench
