#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The meaning of an image's values.
enum class ImageKind { Intensity, Labels, LevelSet };

[[nodiscard]] std::string to_string(ImageKind kind);  ///< "intensity", "labels", "level-set"

/// Classification of an image by its values.
struct ImageJudgement {
    ImageKind kind = ImageKind::Intensity;
    bool inside_below = false;  ///< for a level set: the border of the image is above 0
    std::string reason;         ///< one sentence for the report
};

/// Labels: integers from 0 up, with mostly equal neighbours among those that are not 0. Level set:
/// values of both signs with extremes of equal size. Else intensities.
[[nodiscard]] ImageJudgement judge(const Image& image);

/// The labels (values above 0) of a label map, ascending.
[[nodiscard]] std::vector<int> labels_of(const Image& image);

/// What each label above 0 takes [mm^3].
[[nodiscard]] std::map<int, double> label_volumes(const Image& image);

/// A mask of 1 and 0: voxels whose rounded value is one of `labels`; no labels: any value above 0.
[[nodiscard]] Image mask_of_labels(const Image& image, const std::vector<int>& labels);

/// A mask of 1 and 0: voxels of at least (or, inside_below, at most) `iso`.
[[nodiscard]] Image mask_of_iso(const Image& image, double iso, bool inside_below);

/// Threshold that best separates two classes of values.
/// Source: Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. SMC 1979.
/// \throw InvalidInput if there are no two different values
[[nodiscard]] double otsu(const std::vector<float>& values);

/// Threshold for vessels that are the brightest part of the image: midway between the medians of
/// the two layers of voxels inside their walls and of the two outside. Inside are the voxels above
/// Otsu's threshold, repeated on the values above it while these are more than a twentieth of all
/// voxels (vessels do not fill more of a body image) and the split leaves most of them, tissue,
/// below: a vessel alone is not split again. Otsu's threshold itself depends on voxels far from the
/// wall.
/// \throw InvalidInput if all voxels are equal; Cancelled if the user cancels
[[nodiscard]] double bright_threshold(const Image& image, const Progress& progress = {});

/// Threshold inside a mask: midway between the median of the mask's voxels and the median of the
/// two-voxel ring around it; by the partial volume effect, that is the wall.
/// \throw InvalidInput if the mask is empty, or not brighter inside than around;
/// Cancelled if the user cancels
[[nodiscard]] double masked_threshold(const Image& image, const Image& mask,
                                      const Progress& progress = {});

/// Intensities for the extraction inside a dilated mask (thesis 3.2.2, Fig. 3.7): outside the
/// dilated mask, a voxel on the inner side of the threshold takes the background value (the median
/// of the outer voxels on the other side); all others keep their value, so that no artificial wall
/// appears where the image shows a real one.
/// \param dilated_mask inside where >= 0.5, same grid
[[nodiscard]] Image masked_intensities(const Image& image, const Image& dilated_mask,
                                       double threshold, bool inside_below);

}  // namespace vesselbench
