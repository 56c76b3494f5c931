#include "workbench/review/page_bytes.h"

#include "geometry/formats/image_bytes.h"
#include "workbench/report/base64.h"

namespace vesselbench {

namespace {

template <class Number>
void append_differences(std::string& bytes, std::span<const Number> numbers) {
    const std::size_t begin = bytes.size(), count = numbers.size();
    bytes.resize(begin + count * sizeof(Number));
    Number before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto difference = static_cast<Number>(numbers[i] - before);
        before = numbers[i];
        for (std::size_t b = 0; b < sizeof(Number); ++b)
            bytes[begin + b * count + i] = static_cast<char>((difference >> (8 * b)) & 0xff);
    }
}

template <class Number>
void append_bytes(std::string& bytes, Number number) {
    for (std::size_t b = 0; b < sizeof(Number); ++b)
        bytes.push_back(static_cast<char>((number >> (8 * b)) & 0xff));
}

}  // namespace

void append_plane(std::string& bytes, std::span<const std::uint16_t> numbers) {
    append_differences(bytes, numbers);
}

void append_plane(std::string& bytes, std::span<const std::uint32_t> numbers) {
    append_differences(bytes, numbers);
}

void append_number(std::string& bytes, std::uint16_t number) {
    append_bytes(bytes, number);
}

void append_number(std::string& bytes, std::uint32_t number) {
    append_bytes(bytes, number);
}

std::string packed_text(const std::string& bytes) {
    return base64(deflated(bytes, false, {}));
}

}  // namespace vesselbench
