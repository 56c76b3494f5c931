#pragma once

#include <span>

namespace vesselbench {

// The bytes of the window's fonts, embedded at build time (cmake/EmbedFile.cmake): Roboto, and the
// Material Design icons.
[[nodiscard]] std::span<const unsigned char> window_font();
[[nodiscard]] std::span<const unsigned char> window_medium_font();
[[nodiscard]] std::span<const unsigned char> window_icon_font();

}  // namespace vesselbench
