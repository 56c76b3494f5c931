#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/picture.h"

namespace vesselbench {

/// An image of 8-bit RGBA pixels, rows from the top; colours are not multiplied by alpha.
struct ClearPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// The picture as a PNG file's bytes.
[[nodiscard]] std::string png(const Picture& picture);
[[nodiscard]] std::string png(const ClearPicture& picture);

/// The picture of a PNG file's bytes; none if they are no such file, or damaged.
[[nodiscard]] std::optional<ClearPicture> picture_from_png(std::string_view bytes);

}  // namespace vesselbench
