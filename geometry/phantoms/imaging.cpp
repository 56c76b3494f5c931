#include "geometry/phantoms/imaging.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/phantoms/random.h"

namespace vesselbench {

namespace {

/// Image, mask and the shares of the voxels take 12 bytes each: 3 GiB.
constexpr std::size_t kLargestImage = std::size_t{256} << 20;
/// Samples per axis in a voxel on the surface: partial volume to 1/64 of the contrast.
constexpr int kSupersampling = 4;
/// Different noise for the intensities and the contours of the same phantom.
constexpr std::uint64_t kContourSeed = 0x636f6e746f7572ULL;
constexpr const char* kImageText = "making the phantom's image";

void check_size(const Vec3& size) {
    const std::string text = formatted(size.x(), "%.0f") + " x " + formatted(size.y(), "%.0f") +
                             " x " + formatted(size.z(), "%.0f") + " voxels";
    if (!(size.minCoeff() >= 2.0))
        throw InvalidInput("a phantom's image of " + text + " holds no volume");
    if (size.prod() > static_cast<double>(kLargestImage))
        throw InvalidInput("the phantom's image would have " + text + ", more than " +
                           formatted(static_cast<double>(kLargestImage) / 1e6, "%.0f") +
                           " million in all; give a larger spacing or a smaller size");
}

Image empty_grid(const PhantomDescription& description, const PhantomField& field) {
    const PhantomImaging& imaging = description.imaging;
    if (!(imaging.spacing.minCoeff() > 0.0))
        throw InvalidInput("a phantom's voxel spacing must be greater than 0");
    // The box of the phantom in the image's own axes.
    const Eigen::AlignedBox3d bounds = field.bounds();
    Eigen::AlignedBox3d box;
    for (int corner = 0; corner < 8; ++corner)
        box.extend(Vec3(imaging.axes.transpose() *
                        bounds.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
    Vec3 size =
        ((box.sizes() + Vec3::Constant(2.0 * imaging.margin)).array() / imaging.spacing.array())
            .ceil();
    if (imaging.size) size = Vec3((*imaging.size)[0], (*imaging.size)[1], (*imaging.size)[2]);
    check_size(size);
    Image image;
    for (int axis = 0; axis < 3; ++axis)
        image.size[static_cast<std::size_t>(axis)] = static_cast<int>(size[axis]);
    const Vec3 steps(image.size[0] - 1, image.size[1] - 1, image.size[2] - 1);
    const Vec3 first = box.center() - 0.5 * steps.cwiseProduct(imaging.spacing);
    image.index_to_patient.topLeftCorner<3, 3>() = imaging.axes * imaging.spacing.asDiagonal();
    image.index_to_patient.topRightCorner<3, 1>() = imaging.axes * first;
    return image;
}

/// Calls row(j, k) for all rows along i, on all threads; reports after every twentieth of them.
template <class Row>
void for_rows(const Image& grid, const Progress& progress, const std::string& what,
              const Row& row) {
    constexpr int kReports = 20;
    const int slices = (grid.size[2] + kReports - 1) / kReports;
    for (int from = 0; from < grid.size[2]; from += slices) {
        progress.report(static_cast<double>(from) / grid.size[2], what);
        const int count = std::min(slices, grid.size[2] - from) * grid.size[1];
        tbb::parallel_for(0, count, [&](int r) {
            progress.check_cancelled();
            row(r % grid.size[1], from + r / grid.size[1]);
        });
    }
}

template <class Function>
std::shared_ptr<const std::vector<float>> filled(const Image& grid, const Progress& progress,
                                                 const std::string& what, const Function& value) {
    auto voxels = std::make_shared<std::vector<float>>(grid.voxel_count());
    for_rows(grid, progress, what, [&](int j, int k) {
        for (int i = 0; i < grid.size[0]; ++i) (*voxels)[grid.offset(i, j, k)] = value(i, j, k);
    });
    return voxels;
}

/// Fraction of the voxel (i, j, k) that lies inside, in [0, 1].
float occupancy(const Image& grid, const PhantomField& field, int i, int j, int k) {
    const double at_centre = field(grid.to_patient(Vec3(i, j, k)));
    // The field changes by at most about 1 mm per mm: beyond half the diagonal, the voxel is full
    // or empty.
    const double reach = 0.55 * grid.spacing().norm();
    if (std::abs(at_centre) > reach) return at_centre < 0.0 ? 1.0F : 0.0F;
    int inside = 0;
    for (int s = 0; s < kSupersampling * kSupersampling * kSupersampling; ++s) {
        const int layer = s / (kSupersampling * kSupersampling);
        const Vec3 cell(s % kSupersampling, s / kSupersampling % kSupersampling, layer);
        const Vec3 offset = (cell + Vec3::Constant(0.5)) / kSupersampling - Vec3::Constant(0.5);
        inside += field(grid.to_patient(Vec3(i, j, k) + offset)) < 0.0 ? 1 : 0;
    }
    return static_cast<float>(inside) / (kSupersampling * kSupersampling * kSupersampling);
}

std::vector<double> gaussian(double sigma_voxels) {
    const int reach = std::max(1, static_cast<int>(std::ceil(4.0 * sigma_voxels)));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        kernel.push_back(std::exp(-0.5 * i * i / (sigma_voxels * sigma_voxels)));
        sum += kernel.back();
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

/// Separable Gaussian along one index axis; the border voxel is repeated outside.
std::vector<float> blurred_along(const Image& grid, const std::vector<float>& voxels, int axis,
                                 double sigma, const Progress& progress) {
    const auto kernel = gaussian(sigma / grid.spacing()[axis]);
    const int reach = static_cast<int>(kernel.size()) / 2;
    std::vector<float> result(voxels.size());
    for_rows(grid, progress, kImageText, [&](int j, int k) {
        for (int i = 0; i < grid.size[0]; ++i) {
            std::array<int, 3> at = {i, j, k};
            const auto a = static_cast<std::size_t>(axis);
            double sum = 0.0;
            for (int n = -reach; n <= reach; ++n) {
                std::array<int, 3> from = at;
                from[a] = std::clamp(at[a] + n, 0, grid.size[a] - 1);
                sum += kernel[static_cast<std::size_t>(n + reach)] *
                       voxels[grid.offset(from[0], from[1], from[2])];
            }
            result[grid.offset(i, j, k)] = static_cast<float>(sum);
        }
    });
    return result;
}

bool deleted(const std::vector<Deletion>& deletions, int i, int j, int k) {
    return std::any_of(deletions.begin(), deletions.end(), [&](const Deletion& d) {
        return i >= d.from[0] && i <= d.to[0] && j >= d.from[1] && j <= d.to[1] && k >= d.from[2] &&
               k <= d.to[2];
    });
}

/// True in the strip that the expert leaves out between two parts: near both, and inside no third
/// one.
bool between(const KeptApart& apart, const std::vector<PhantomPart>& parts,
             const PhantomField& field, const Vec3& p) {
    const double a = field.part(apart.first, p), b = field.part(apart.second, p);
    const bool near_both = std::min(a, b) > -0.5 * apart.gap && std::max(a, b) < apart.gap;
    if (!near_both || std::abs(a - b) >= apart.gap) return false;
    return std::none_of(parts.begin(), parts.end(), [&](const PhantomPart& part) {
        return part.name != apart.first && part.name != apart.second &&
               field.part(part.name, p) < 0.0;
    });
}

/// Relative loss of contrast at a point [-]. \param radius of the vessel at the dip's centre [mm]
double dip_loss(const ContrastDip& dip, double radius, const PhantomField& field, const Vec3& p) {
    const double away = (p - dip.centre).norm() / dip.reach;
    if (away >= 1.0) return 0.0;
    const double off_axis = std::clamp(1.0 + field.part(dip.part, p) / radius, 0.0, 1.0);
    const double loss = dip.core + (dip.wall - dip.core) * off_axis * off_axis;
    return 0.5 * (1.0 + std::cos(std::numbers::pi * away)) * loss;
}

/// What is left of the contrast at each voxel's centre after all dips, multiplied into the shares.
void take_dips(const std::vector<ContrastDip>& dips, const Image& grid, const PhantomField& field,
               std::vector<float>& share, const Progress& progress) {
    for (const ContrastDip& dip : dips) {
        if (!(dip.reach > 0.0)) throw InvalidInput("a contrast dip's reach must be greater than 0");
        const double radius = -field.part(dip.part, dip.centre);
        if (!(radius > 0.0))
            throw InvalidInput("a contrast dip's centre must be inside '" + dip.part + "'");
        for_rows(grid, progress, kImageText, [&](int j, int k) {
            for (int i = 0; i < grid.size[0]; ++i) {
                float& value = share[grid.offset(i, j, k)];
                if (value > 0.0F)
                    value *= static_cast<float>(
                        1.0 - dip_loss(dip, radius, field, grid.to_patient(Vec3(i, j, k))));
            }
        });
    }
}

/// Slowly varying loss of contrast in [0, 1], one and a half waves over the image along each axis.
double contrast_loss(const Image& grid, int i, int j, int k, double phase) {
    const double waves = 3.0 * 3.14159265358979;
    const double x = waves * i / grid.size[0], y = waves * j / grid.size[1],
                 z = waves * k / grid.size[2];
    return 0.5 + 0.5 * std::sin(x + phase) * std::cos(y - phase) * std::sin(z + 2.0 * phase);
}

}  // namespace

Image phantom_image(const PhantomDescription& description, const PhantomField& field,
                    const Progress& progress) {
    const PhantomImaging& imaging = description.imaging;
    Image image = empty_grid(description, field);
    std::vector<float> share =
        *filled(image, progress.part(0.0, 0.6), kImageText, [&](int i, int j, int k) {
            return deleted(imaging.deletions, i, j, k) ? 0.0F : occupancy(image, field, i, j, k);
        });
    take_dips(imaging.dips, image, field, share, progress.silent());
    for (int axis = 0; axis < 3; ++axis)
        if (imaging.blur[axis] > 0.0)
            share = blurred_along(image, share, axis, imaging.blur[axis],
                                  progress.part(0.6 + 0.1 * axis, 0.7 + 0.1 * axis));
    const double phase = 6.283 * uniform_noise(description.seed, 0);
    image.voxels = filled(image, progress.part(0.9, 1.0), kImageText, [&](int i, int j, int k) {
        const std::size_t at = image.offset(i, j, k);
        const double contrast =
            (imaging.inside - imaging.outside) *
            (1.0 - imaging.inhomogeneity * contrast_loss(image, i, j, k, phase));
        const double noise =
            imaging.noise > 0.0 ? imaging.noise * normal_noise(description.seed, at) : 0.0;
        return static_cast<float>(imaging.outside + contrast * share[at] + noise);
    });
    return image;
}

Image phantom_mask(const PhantomDescription& description, const PhantomField& field,
                   const Progress& progress) {
    const PhantomImaging& imaging = description.imaging;
    Image mask = empty_grid(description, field);
    const int step = std::max(1, imaging.mask_slice_step);
    mask.voxels = filled(mask, progress, "making the phantom's mask", [&](int i, int j, int k) {
        const int drawn = std::min(k / step * step + step / 2, mask.size[2] - 1);
        if (deleted(imaging.deletions, i, j, drawn)) return 0.0F;
        const Vec3 p = mask.to_patient(Vec3(i, j, drawn));
        const double offset =
            imaging.mask_jitter > 0.0
                ? imaging.mask_jitter * normal_noise(description.seed ^ kContourSeed,
                                                     static_cast<std::uint64_t>(drawn))
                : 0.0;
        if (field(p) > offset) return 0.0F;
        for (const KeptApart& apart : imaging.kept_apart)
            if (between(apart, description.parts, field, p)) return 0.0F;
        return 1.0F;
    });
    return mask;
}

}  // namespace vesselbench
