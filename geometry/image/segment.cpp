#include "geometry/image/segment.h"

#include <algorithm>
#include <cmath>

#include "geometry/image/voxels.h"

namespace vesselbench {

namespace {

std::map<int, VoxelBox> boxes_of(const Image& labels) {
    std::map<int, VoxelBox> boxes;
    for (int k = 0; k < labels.size[2]; ++k)
        for (int j = 0; j < labels.size[1]; ++j)
            for (int i = 0; i < labels.size[0]; ++i)
                if (const float value = labels.at(i, j, k); value > 0.0f)
                    boxes[static_cast<int>(std::lround(value))].add({i, j, k});
    boxes.erase(0);
    return boxes;
}

}  // namespace

std::string name_of_label(const std::vector<Segment>& segments, int label) {
    const auto found = std::ranges::find(segments, label, &Segment::label);
    return found == segments.end() || found->name.empty() ? "label " + std::to_string(label)
                                                          : found->name;
}

std::map<int, LabelSize> label_sizes(const Image& labels) {
    const Vec3 spacing = labels.spacing();
    std::map<int, LabelSize> sizes;
    for (const auto& [label, box] : boxes_of(labels)) {
        LabelSize& size = sizes[label];
        size.volume = static_cast<double>(box.count) * spacing.prod();
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<Eigen::Index>(a);
            size.size[axis] = spacing[axis] * (box.high[a] - box.low[a] + 1);
        }
    }
    return sizes;
}

}  // namespace vesselbench
