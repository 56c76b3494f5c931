#include "workbench/review/acceptance.h"

#include <charconv>
#include <string_view>
#include <system_error>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"

namespace vesselbench {

std::size_t required_reviewers(const std::string& text, const std::string& asked) {
    constexpr std::string_view kWord = "accepted";
    std::size_t count = text == kWord ? 1 : 0;
    if (text.starts_with(std::string(kWord) + "=")) {
        const char* end = text.data() + text.size();
        const auto read = std::from_chars(text.data() + kWord.size() + 1, end, count);
        if (read.ec != std::errc() || read.ptr != end) count = 0;
    }
    if (count == 0)
        throw UsageError(asked + " '" + shortened(printable(text)) +
                         "': give accepted, or accepted=N for N reviewers (at least 1)");
    return count;
}

}  // namespace vesselbench
