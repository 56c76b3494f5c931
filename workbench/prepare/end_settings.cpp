#include "workbench/prepare/end_settings.h"

#include <algorithm>
#include <sstream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

bool is_number_of_end(const std::string& text) {
    return !text.empty() && text.size() < 6 &&
           std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

bool is_coordinate(const std::string& text) {
    std::istringstream stream(text);
    double value = 0.0;
    return static_cast<bool>(stream >> value) && stream.eof();
}

}  // namespace

std::vector<std::string> end_settings(const std::string& what, std::span<const std::string> texts) {
    std::vector<std::string> numbers, places;
    for (const std::string& text : texts) {
        const std::vector<std::string> parts = parts_of(text);
        if (!parts.empty() && std::ranges::all_of(parts, is_number_of_end))
            numbers.insert(numbers.end(), parts.begin(), parts.end());
        else if (!parts.empty() && parts.size() % 3 == 0 &&
                 std::ranges::all_of(parts, is_coordinate))
            places.insert(places.end(), parts.begin(), parts.end());
        else
            throw UsageError("--" + what + " '" + text +
                             "': give numbers of ends, such as 1 or 4,7 (vesselbench ends lists "
                             "them), or a place x,y,z in mm");
    }
    std::vector<std::string> settings;
    if (!numbers.empty())
        settings.push_back("clip-opening." + what + "_ends=" + joined(numbers, ","));
    if (!places.empty())
        settings.push_back("clip-opening." + (what == "close" ? "closed" : what) + "=" +
                           joined(places, ","));
    return settings;
}

}  // namespace vesselbench
