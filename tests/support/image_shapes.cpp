#include "tests/support/image_shapes.h"

#include <algorithm>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"

namespace vesselbench::test {

Eigen::Matrix4d oblique_matrix(const Vec3& spacing, const Vec3& origin, bool mirrored) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = skew_rotation() * spacing.asDiagonal();
    if (mirrored) matrix.col(0) *= -1.0;
    matrix.topRightCorner<3, 1>() = origin;
    return matrix;
}

Image image_of(const std::array<int, 3>& size, const Eigen::Matrix4d& matrix,
               const std::function<double(const Vec3&)>& value) {
    Image image;
    image.size = size;
    image.index_to_patient = matrix;
    std::vector<float> voxels;
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i)
                voxels.push_back(static_cast<float>(value(image.to_patient(Vec3(i, j, k)))));
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return image;
}

Vec3 middle_of(const Image& image) {
    return image.to_patient(0.5 * Vec3(image.size[0] - 1, image.size[1] - 1, image.size[2] - 1));
}

Image ball_image(double radius, int size, const Vec3& spacing, bool mirrored) {
    Image grid;
    grid.size = {size, size, size};
    grid.index_to_patient = oblique_matrix(spacing, Vec3(-40.0, 13.0, 77.0), mirrored);
    const Vec3 middle = middle_of(grid);
    return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return 100.0 * std::clamp(0.5 + 0.5 * (radius - (p - middle).norm()), 0.0, 1.0);
    });
}

std::string message_of(const std::string& path) {
    try {
        (void)read_image(path);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace vesselbench::test
