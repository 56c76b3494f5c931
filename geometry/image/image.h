#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A scalar image (or a label map) in patient space: an immutable value with shared voxels.
struct Image {
    std::array<int, 3> size = {0, 0, 0};  ///< voxels along i, j, k
    /// Maps a voxel's index (i, j, k, 1) to the patient position of its centre [mm], LPS. May be
    /// oblique or left-handed.
    Eigen::Matrix4d index_to_patient = Eigen::Matrix4d::Identity();
    std::shared_ptr<const std::vector<float>>
        voxels;  ///< i fastest, then j, then k; labels are whole numbers

    [[nodiscard]] bool empty() const { return !voxels || voxels->empty(); }

    [[nodiscard]] std::size_t voxel_count() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]);
    }

    [[nodiscard]] std::size_t offset(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(i);
    }

    [[nodiscard]] float at(int i, int j, int k) const { return (*voxels)[offset(i, j, k)]; }

    /// Lengths of the voxel edges [mm] along i, j, k.
    [[nodiscard]] Vec3 spacing() const;
    /// Patient position [mm] of a (fractional) voxel index.
    [[nodiscard]] Vec3 to_patient(const Vec3& index) const;
    /// (Fractional) voxel index of a patient position [mm].
    [[nodiscard]] Vec3 to_index(const Vec3& patient) const;
};

/// Three axes, three spacings and a confidence: the known sampling of a surface's source image. It
/// serves the stack direction and the voxel cells of context-aware smoothing (thesis 5.3.1, node
/// position constraint).
struct Sampling {
    Eigen::Matrix3d axes =
        Eigen::Matrix3d::Identity();  ///< unit columns; column 2 is the stack direction
    Vec3 spacing = Vec3::Zero();      ///< [mm] along the axes
    double confidence = 0.0;          ///< [-] in [0, 1]; 1 if it comes from the image
};

[[nodiscard]] Sampling sampling_of(const Image& image);

/// For headers that were rounded.
/// \throw InvalidInput that says what differs, unless both have the same size and their corners lie
/// within a tenth of a voxel of each other
void require_same_place(const Image& image, const Image& mask);

/// True if both have the same size and the same index-to-patient matrix (to a thousandth of a
/// voxel).
[[nodiscard]] bool same_grid(const Image& a, const Image& b);

}  // namespace vesselbench
