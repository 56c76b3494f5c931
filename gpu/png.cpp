#include "gpu/png.h"

#include <cstdint>

#include <zlib.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

void append_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<char>(number >> shift & 0xff));
}

/// One chunk: length, type, data, checksum (PNG specification, section 5.3).
void append_chunk(std::string& file, const std::string& type, const std::string& data) {
    append_number(file, static_cast<std::uint32_t>(data.size()));
    const std::string body = type + data;
    file += body;
    const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
    append_number(file,
                  static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(body.size()))));
}

}  // namespace

std::string png(const Picture& picture) {
    std::string rows;
    const auto row = static_cast<std::size_t>(picture.width) * 3;
    for (int y = 0; y < picture.height; ++y) {
        rows.push_back('\0');  // no filter
        rows.append(
            reinterpret_cast<const char*>(picture.rgb.data()) + static_cast<std::size_t>(y) * row,
            row);
    }
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    std::string packed(size, '\0');
    if (compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                 reinterpret_cast<const Bytef*>(rows.data()),
                 static_cast<uLong>(rows.size())) != Z_OK)
        throw AlgorithmFailure("the picture could not be compressed");
    packed.resize(size);
    std::string header;
    append_number(header, static_cast<std::uint32_t>(picture.width));
    append_number(header, static_cast<std::uint32_t>(picture.height));
    header += std::string("\x08\x02\x00\x00\x00",
                          5);  // 8 bits, RGB, deflate, no filter method, not interlaced
    std::string file("\x89PNG\r\n\x1a\n", 8);
    append_chunk(file, "IHDR", header);
    append_chunk(file, "IDAT", packed);
    append_chunk(file, "IEND", "");
    return file;
}

}  // namespace vesselbench
