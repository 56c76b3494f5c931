#include "geometry/formats/comment_line.h"

#include <algorithm>
#include <string_view>

#include "geometry/kernel/printable.h"

namespace vesselbench {

std::string comment_line(const std::string& text, std::size_t most) {
    constexpr std::string_view kMeanSomething = "\n\t=#$%*/\\<>\"'&;{}[]";
    std::string line = printable(text);
    std::ranges::replace_if(
        line, [&](char c) { return kMeanSomething.find(c) != std::string_view::npos; }, '_');
    if (line.size() <= most) return line;
    while (most > 0 && (static_cast<unsigned char>(line[most]) & 0xc0U) == 0x80U) --most;
    line.resize(most);
    return line;
}

}  // namespace vesselbench
