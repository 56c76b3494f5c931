#include "geometry/formats/slicer_segments.h"

#include <algorithm>
#include <cmath>

#include "geometry/formats/image_bytes.h"
#include "geometry/formats/segment_name.h"

namespace vesselbench {

namespace {

/// Segments of a header; more are not of Slicer.
constexpr int kMostSegments = 10000;

const std::string* find(const NrrdPairs& pairs, int segment, const char* field) {
    const auto found = pairs.find("Segment" + std::to_string(segment) + "_" + field);
    return found == pairs.end() ? nullptr : &found->second;
}

std::optional<int> whole_number(const std::string* text) {
    const auto number = text ? number_in(*text) : std::nullopt;
    if (!number || *number != std::floor(*number) || std::abs(*number) > 1e6) return std::nullopt;
    return static_cast<int>(*number);
}

/// Three fractions of full intensity.
std::optional<std::array<std::uint8_t, 3>> colour_of(const std::string* text) {
    const auto words = words_of(text ? *text : "");
    if (words.size() != 3) return std::nullopt;
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto number = number_in(words[c]);
        if (!number || !(*number >= 0.0 && *number <= 1.0)) return std::nullopt;
        colour[c] = static_cast<std::uint8_t>(std::lround(255.0 * *number));
    }
    return colour;
}

}  // namespace

void read_slicer_segments(const NrrdPairs& pairs, ImageFile& file) {
    const bool layered = !file.layers.empty();
    for (int s = 0; s < kMostSegments; ++s) {
        const std::string *name = find(pairs, s, "Name"), *id = find(pairs, s, "ID");
        if (name == nullptr && id == nullptr) break;
        const auto value = whole_number(find(pairs, s, "LabelValue"));
        const int layer = whole_number(find(pairs, s, "Layer")).value_or(0);
        const bool there = layer >= 0 && static_cast<std::size_t>(layer) <= file.layers.size();
        if (!value || *value < 1 || !there) {
            file.notes.push_back("segment " + std::to_string(s + 1) +
                                 " of the file has no label of its own and is left out");
            continue;
        }
        const int label = layered ? s + 1 : *value;
        file.segments.push_back({.label = label,
                                 .name = segment_name(name ? *name : *id),
                                 .colour = colour_of(find(pairs, s, "Color"))});
        if (layered) file.stored.push_back({static_cast<std::size_t>(layer), *value});
    }
}

}  // namespace vesselbench
