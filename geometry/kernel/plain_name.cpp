#include "geometry/kernel/plain_name.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLongest = 64;
constexpr std::size_t kMostListed = 5;  // changed names in a note

bool is_plain(char c) {  // not isalnum(), which depends on the locale
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
}

std::string replaced(std::string_view foreign) {
    std::string name;
    bool gap = false;
    for (const char c : foreign) {
        if (!is_plain(c)) {
            gap = true;
            continue;
        }
        if (gap && !name.empty()) name += '_';
        gap = false;
        name += c;
        if (name.size() == kLongest) break;
    }
    return name.empty() ? "unnamed" : name;
}

std::string numbered(const std::string& name, int number) {
    const std::string suffix = "_" + std::to_string(number);
    return name.substr(0, kLongest - suffix.size()) + suffix;
}

}  // namespace

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, is_plain);
}

std::string plain_name_rule() {
    return "1 to " + std::to_string(kLongest) + " letters, digits, '_', '-' and '.'";
}

void require_plain_name(std::string_view name, const std::string& what) {
    if (!is_plain_name(name))
        throw InvalidInput(what + " is named '" + shortened(printable(name)) +
                           "', but a name consists of " + plain_name_rule() + ": rename it");
}

void require_plain_names(std::span<const Patch> patches) {
    for (const Patch& patch : patches) require_plain_name(patch.name, "a patch");
}

std::string PlainNames::add(std::string_view foreign) {
    const std::string wanted = is_plain_name(foreign) ? std::string(foreign) : replaced(foreign);
    std::string name = wanted;
    for (int number = 2; !taken_.insert(name).second; ++number) name = numbered(wanted, number);
    if (name != foreign)
        changed_.push_back("'" + shortened(printable(foreign)) + "' is now " + name);
    return name;
}

std::string PlainNames::note() const {
    if (changed_.empty()) return {};
    std::vector<std::string> listed = changed_;
    if (listed.size() > kMostListed) {
        listed.resize(kMostListed);
        listed.push_back(std::to_string(changed_.size() - kMostListed) + " more");
    }
    return "names were changed, which consist of " + plain_name_rule() +
           " and differ from each other: " + joined(listed);
}

}  // namespace vesselbench
