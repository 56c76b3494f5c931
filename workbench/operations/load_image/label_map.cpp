#include "workbench/operations/load_image/label_map.h"

#include <algorithm>
#include <map>

#include "geometry/image/threshold.h"
#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/label_choice.h"

namespace vesselbench {

namespace {

const Image& layer_of(const ImageFile& file, std::size_t layer) {
    return layer == 0 ? file.image : file.layers[layer - 1];
}

/// A segment alone, with its label.
Image alone(const ImageFile& file, std::size_t segment) {
    const ImageFile::Stored& stored = file.stored[segment];
    Image image = mask_of_labels(layer_of(file, stored.layer), {stored.value});
    std::vector<float> voxels = *image.voxels;
    for (float& v : voxels) v *= static_cast<float>(file.segments[segment].label);
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return image;
}

std::map<int, LabelSize> sizes_of(const ImageFile& file) {
    std::map<int, LabelSize> sizes;
    for (std::size_t s = 0; s < file.segments.size(); ++s) sizes.merge(label_sizes(alone(file, s)));
    return sizes;
}

}  // namespace

void join_layers(ImageFile& file, const std::string& choice) {
    if (file.layers.empty()) return;
    const std::map<int, LabelSize> sizes = sizes_of(file);
    if (sizes.empty()) throw InvalidInput("the segmentation is empty: it has no voxel inside");
    if (choice.empty()) throw DiagnosedUsage(label_unchosen(file.segments, sizes));
    std::vector<int> there;
    for (const auto& [label, size] : sizes) there.push_back(label);
    const std::vector<int> chosen = labels_named(choice, file.segments, there);
    std::vector<float> voxels(file.image.voxel_count());
    for (const bool on_top : {false, true})
        for (std::size_t s = 0; s < file.segments.size(); ++s) {
            if (std::ranges::binary_search(chosen, file.segments[s].label) != on_top) continue;
            const Image segment = alone(file, s);
            for (std::size_t v = 0; v < voxels.size(); ++v)
                if ((*segment.voxels)[v] > 0.0f) voxels[v] = (*segment.voxels)[v];
        }
    file.image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    file.layers.clear();
}

Segmentation segmentation_of(const Image& labels, const std::vector<Segment>& segments,
                             const std::string& choice) {
    Segmentation segmentation{.segments = segments};
    std::ranges::stable_sort(segmentation.segments, {}, &Segment::label);
    if (!choice.empty())
        segmentation.vessel = labels_named(choice, segmentation.segments, labels_of(labels));
    return segmentation;
}

}  // namespace vesselbench
