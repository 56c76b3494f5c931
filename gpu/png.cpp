#include "gpu/png.h"

#include <png.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

png_image png_of(int width, int height, png_uint_32 format) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    return image;
}

std::string encoded(png_image image, const std::uint8_t* pixels) {
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr))
        throw AlgorithmFailure(std::string("the picture could not be encoded: ") + image.message);
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string png(const Picture& picture) {
    return encoded(png_of(picture.width, picture.height, PNG_FORMAT_RGB), picture.rgb.data());
}

std::string png(const ClearPicture& picture) {
    return encoded(png_of(picture.width, picture.height, PNG_FORMAT_RGBA), picture.rgba.data());
}

std::optional<ClearPicture> picture_from_png(std::string_view bytes) {
    constexpr png_uint_32 kMostPixels = 4096;  // of a side: larger ones are no pictures of ours
    png_image image = png_of(0, 0, PNG_FORMAT_RGBA);
    if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) return std::nullopt;
    image.format = PNG_FORMAT_RGBA;
    ClearPicture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    if (image.width > kMostPixels || image.height > kMostPixels) {
        png_image_free(&image);
        return std::nullopt;
    }
    picture.rgba.resize(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr))
        return std::nullopt;
    return picture;
}

}  // namespace vesselbench
