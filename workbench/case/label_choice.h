#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/image/segment.h"
#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

struct Scene;

/// The voxels of a scene's labels: of its mask, else of its image.
/// \pre the scene has an image
[[nodiscard]] const Image& label_image(const Scene& scene);

/// The labels that a user names.
/// \param text names or labels, separated by commas, or "all"; a name may be written in any case
/// \param there labels that occur in the voxels, ascending
/// \return ascending
/// \throw UsageError that lists what there is, if something is not there
[[nodiscard]] std::vector<int> labels_named(const std::string& text,
                                            const std::vector<Segment>& segments,
                                            const std::vector<int>& there);

/// The labels with their names, volumes [ml] and sizes [mm], a line each.
[[nodiscard]] std::string label_list(const std::vector<Segment>& segments,
                                     const std::map<int, LabelSize>& sizes);

/// The code of label_unchosen().
inline constexpr const char* kLabelUnchosen = "label-unchosen";

/// What is missing where there are several labels and none is chosen: the list, and how to choose;
/// each label is an answer, in their order, which says nothing about what is likelier.
/// \pre sizes are not empty
[[nodiscard]] Diagnostic label_unchosen(const std::vector<Segment>& segments,
                                        const std::map<int, LabelSize>& sizes);

}  // namespace vesselbench
