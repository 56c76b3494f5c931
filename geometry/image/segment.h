#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"

namespace vesselbench {

/// A structure of a label map.
struct Segment {
    int label = 0;     ///< its voxels' value, above 0
    std::string name;  ///< UTF-8, as a user typed it; empty: none
    std::optional<std::array<std::uint8_t, 3>> colour = std::nullopt;  ///< red, green, blue

    bool operator==(const Segment&) const = default;
};

/// What is known of a label map beside its voxels.
struct Segmentation {
    std::vector<Segment> segments;  ///< ascending labels; those without a name may be missing
    std::vector<int> vessel;        ///< labels that were chosen as the vessel; empty: not chosen

    [[nodiscard]] bool empty() const { return segments.empty() && vessel.empty(); }

    bool operator==(const Segmentation&) const = default;
};

/// The name, else "label 3".
[[nodiscard]] std::string name_of_label(const std::vector<Segment>& segments, int label);

/// How large a label is.
struct LabelSize {
    double volume = 0.0;       ///< [mm^3] of its voxels
    Vec3 size = Vec3::Zero();  ///< [mm] along the image's axes, of the voxels' box
};

/// Of each label above 0.
[[nodiscard]] std::map<int, LabelSize> label_sizes(const Image& labels);

}  // namespace vesselbench
