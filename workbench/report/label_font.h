#pragma once

#include <span>

namespace vesselbench {

/// The bytes of the TrueType font of labels, embedded at build time (cmake/EmbedFile.cmake).
[[nodiscard]] std::span<const unsigned char> label_font();

}  // namespace vesselbench
