#include "geometry/image/slices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

constexpr double kAligned = 1e-4;           ///< a voxel edge may deviate so much from its axis [-]
constexpr double kMostPixels = 1024;        ///< of oblique images, along an axis
constexpr double kBorder = 1e-6;            ///< rounding of places on the image's border [voxels]
constexpr std::size_t kSamples = 1U << 20;  ///< voxels that percentiles are found from
constexpr double kTail = 0.005;  ///< fraction of voxels beyond the automatic window, each end

constexpr SliceAxes kAxial{"Axial", "axial", 0, 1, true, 2};
constexpr SliceAxes kCoronal{"Coronal", "coronal", 0, 2, false, 1};
constexpr SliceAxes kSagittal{"Sagittal", "sagittal", 1, 2, false, 0};

Eigen::Array3d counts_of(const Image& image) {
    return {static_cast<double>(image.size[0]), static_cast<double>(image.size[1]),
            static_cast<double>(image.size[2])};
}

/// Corner (0 to 7) of the image's outer border.
Vec3 corner_of(const Image& image, int corner) {
    const Vec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    return image.to_patient(side.array() * counts_of(image) - 0.5);
}

Bounds bounds_of(const Image& image) {
    Bounds box{corner_of(image, 0), corner_of(image, 0)};
    for (int corner = 1; corner < 8; ++corner) {
        box.min = box.min.cwiseMin(corner_of(image, corner));
        box.max = box.max.cwiseMax(corner_of(image, corner));
    }
    return box;
}

/// The image's axis along each patient axis; none if it is oblique.
std::optional<std::array<int, 3>> aligned_axes(const Image& image) {
    std::array<int, 3> axes = {-1, -1, -1};
    for (int i = 0; i < 3; ++i) {
        const Vec3 edge = image.index_to_patient.block<3, 1>(0, i).normalized().cwiseAbs();
        Eigen::Index nearest = 0;
        if (edge.maxCoeff(&nearest) < 1.0 - kAligned * kAligned) return std::nullopt;
        axes[static_cast<std::size_t>(nearest)] = i;
    }
    return std::ranges::count(axes, -1) == 0 ? std::optional(axes) : std::nullopt;
}

/// A walk over an image's voxels by their fractional index.
class Sampler {
public:
    Sampler(const Image& image, Between between)
        : image_(image), between_(between), last_(counts_of(image) - 1.0) {}

    [[nodiscard]] float at(const Vec3& index) const {
        const Eigen::Array3d place = index.array();
        if ((place < -0.5 - kBorder).any() || (place > last_ + 0.5 + kBorder).any())
            return std::numeric_limits<float>::quiet_NaN();
        const Eigen::Array3d inside = place.max(0.0).min(last_);
        return between_ == Between::Nearest ? nearest(inside) : linear(inside);
    }

private:
    [[nodiscard]] float nearest(const Eigen::Array3d& place) const {
        const Eigen::Array3i voxel = (place + 0.5).floor().cast<int>().min(last_.cast<int>());
        return image_.at(voxel[0], voxel[1], voxel[2]);
    }

    [[nodiscard]] float linear(const Eigen::Array3d& place) const {
        const Eigen::Array3i low = place.cast<int>(), high = (low + 1).min(last_.cast<int>());
        const Eigen::Array3f t = (place - low.cast<double>()).cast<float>();
        const auto row = [&](int j, int k) {
            const float a = image_.at(low[0], j, k), b = image_.at(high[0], j, k);
            return a + t[0] * (b - a);
        };
        const auto layer = [&](int k) {
            const float a = row(low[1], k), b = row(high[1], k);
            return a + t[1] * (b - a);
        };
        const float a = layer(low[2]), b = layer(high[2]);
        return a + t[2] * (b - a);
    }

    const Image& image_;
    Between between_;
    Eigen::Array3d last_;
};

/// Some of the voxels in equal distances, without those that are no number.
std::vector<float> sampled(const std::vector<float>& voxels) {
    const std::size_t stride = std::max<std::size_t>(1, voxels.size() / kSamples);
    std::vector<float> samples;
    for (std::size_t i = 0; i < voxels.size(); i += stride)
        if (std::isfinite(voxels[i])) samples.push_back(voxels[i]);
    return samples;
}

GreyWindow window_between(double black, double white) {
    return {.window = white > black ? white - black : 1.0, .level = (black + white) / 2};
}

Plane plane_at(SlicePlane plane, double position) {
    const int axis = axes_of(plane).normal;
    return {.point = position * Vec3::Unit(axis), .normal = Vec3::Unit(axis)};
}

Surface box_of(const Image& image) {
    Positions corners;
    for (int corner = 0; corner < 8; ++corner) corners.push_back(corner_of(image, corner));
    return make_surface(std::move(corners), {{0, 2, 3},
                                             {0, 3, 1},
                                             {4, 5, 7},
                                             {4, 7, 6},
                                             {0, 1, 5},
                                             {0, 5, 4},
                                             {2, 6, 7},
                                             {2, 7, 3},
                                             {0, 4, 6},
                                             {0, 6, 2},
                                             {1, 3, 7},
                                             {1, 7, 5}});
}

std::size_t at(int axis) {
    return static_cast<std::size_t>(axis);
}

}  // namespace

const SliceAxes& axes_of(SlicePlane plane) {
    return plane == SlicePlane::Axial     ? kAxial
           : plane == SlicePlane::Coronal ? kCoronal
                                          : kSagittal;
}

Vec3 right_of(SlicePlane plane) {
    return Vec3::Unit(axes_of(plane).across);
}

Vec3 up_of(SlicePlane plane) {
    const SliceAxes& axes = axes_of(plane);
    return (axes.along_down ? -1.0 : 1.0) * Vec3::Unit(axes.along);
}

char patient_letter(const Vec3& direction) {
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    return direction[axis] < 0 ? "RAI"[axis] : "LPS"[axis];
}

std::string position_text(int axis, double position) {
    const double shown = std::round(10 * position) / 10;
    return std::string(1, patient_letter(shown < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3::Unit(axis))) +
           " " + formatted(std::abs(shown), "%.1f mm");
}

// --- pixels

Vec3 SliceGrid::high() const {
    return low + Vec3(count[0] * step[0], count[1] * step[1], count[2] * step[2]);
}

double SliceGrid::snapped(int axis, double position) const {
    const double number = std::floor((position - low[axis]) / step[axis]);
    return low[axis] +
           (std::clamp(number, 0.0, std::max(0.0, count[at(axis)] - 1.0)) + 0.5) * step[axis];
}

Vec3 SliceGrid::snapped(const Vec3& point) const {
    return {snapped(0, point[0]), snapped(1, point[1]), snapped(2, point[2])};
}

SliceGrid slice_grid(const Image& image) {
    const Bounds box = bounds_of(image);
    SliceGrid grid{.low = box.min};
    const Vec3 extent = box.max - box.min;
    if (const auto axes = aligned_axes(image)) {
        for (std::size_t a = 0; a < 3; ++a) grid.count[a] = image.size[at((*axes)[a])];
        for (int a = 0; a < 3; ++a) grid.step[a] = extent[a] / grid.count[at(a)];
        return grid;
    }
    const double edge = std::max(image.spacing().minCoeff(), extent.maxCoeff() / kMostPixels);
    grid.step = Vec3::Constant(edge);
    for (int a = 0; a < 3; ++a)
        grid.count[at(a)] = std::max(1, static_cast<int>(std::ceil(extent[a] / edge - kBorder)));
    return grid;
}

ImageSlice slice_of(const Image& image, const SliceGrid& grid, SlicePlane plane, double position,
                    Between between) {
    const SliceAxes& axes = axes_of(plane);
    const Vec3 right = right_of(plane), down = -up_of(plane), high = grid.high();
    ImageSlice slice{.columns = grid.count[at(axes.across)], .rows = grid.count[at(axes.along)]};
    slice.corner[axes.across] = grid.low[axes.across];
    slice.corner[axes.along] = axes.along_down ? grid.low[axes.along] : high[axes.along];
    slice.corner[axes.normal] = position;
    slice.across = slice.columns * grid.step[axes.across] * right;
    slice.down = slice.rows * grid.step[axes.along] * down;
    const Vec3 first = image.to_index(slice.corner + 0.5 * grid.step[axes.across] * right +
                                      0.5 * grid.step[axes.along] * down);
    const Vec3 origin = image.to_index(Vec3::Zero());
    const Vec3 by_column = image.to_index(grid.step[axes.across] * right) - origin;
    const Vec3 by_row = image.to_index(grid.step[axes.along] * down) - origin;
    const Sampler sampler(image, between);
    slice.values.reserve(static_cast<std::size_t>(slice.rows) *
                         static_cast<std::size_t>(slice.columns));
    for (int row = 0; row < slice.rows; ++row)
        for (int column = 0; column < slice.columns; ++column)
            slice.values.push_back(sampler.at(first + row * by_row + column * by_column));
    return slice;
}

std::optional<float> voxel_at(const Image& image, const Vec3& point) {
    if (image.empty()) return std::nullopt;
    const float value = Sampler(image, Between::Nearest).at(image.to_index(point));
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

// --- values

ImageFigures figures_of(const Image& image) {
    ImageFigures figures{.kind = judge(image).kind};
    const auto [least, most] = std::ranges::minmax_element(*image.voxels);
    figures.least = *least;
    figures.most = *most;
    std::vector<float> samples = sampled(*image.voxels);
    if (figures.kind == ImageKind::Labels || samples.empty()) {
        figures.automatic = window_between(0.0, figures.most);
        return figures;
    }
    const double black = percentile(samples, kTail), white = percentile(samples, 1.0 - kTail);
    figures.automatic =
        white > black ? window_between(black, white) : window_between(figures.least, figures.most);
    return figures;
}

// --- curves

std::vector<SliceLine> outline_of(const Surface& surface, SlicePlane plane, double position) {
    std::vector<SliceLine> lines;
    for (SectionCurve& curve : cross_sections(surface, plane_at(plane, position)))
        lines.push_back({std::move(curve.points), curve.closed});
    return lines;
}

std::vector<SliceLine> border_of(const Image& image, SlicePlane plane, double position) {
    return outline_of(box_of(image), plane, position);
}

}  // namespace vesselbench
