#include "geometry/formats/segment_name.h"

#include <algorithm>

#include "geometry/formats/image_bytes.h"
#include "geometry/kernel/printable.h"

namespace vesselbench {

std::string segment_name(std::string_view foreign) {
    constexpr std::size_t kLongest = 64;
    std::string name = printable(trimmed(foreign));
    std::ranges::replace_if(
        name, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return shortened(name, kLongest);
}

}  // namespace vesselbench
