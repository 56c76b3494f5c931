#include "tests/review/packed_bytes.h"

#include <cstdint>

#include <catch2/catch.hpp>
#include <zlib.h>

namespace vesselbench::test {

namespace {

std::string from_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char letter : text) {
        if (letter == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(letters.find(letter));
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<char>(bits >> count & 0xff));
    }
    return bytes;
}

}  // namespace

std::string unpacked(const std::string& text, std::size_t size) {
    const std::string packed = from_base64(text);
    std::string bytes(size + 1, '\0');
    uLongf length = bytes.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
    REQUIRE(length == size);
    bytes.resize(size);
    return bytes;
}

}  // namespace vesselbench::test
