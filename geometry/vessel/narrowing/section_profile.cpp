#include "geometry/vessel/narrowing/section_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>

#include "geometry/kernel/statistics.h"

namespace vesselbench {

namespace {

constexpr double kStep = 0.25;  ///< of a profile, in the shortest edge of the voxels
constexpr int kStrips = 48;     ///< of a disc, at least; more where the blur is small

/// Samples an image between its voxels.
class Sampler {
public:
    explicit Sampler(const Image& image)
        : image_(image), to_index_(image.index_to_patient.inverse()) {}

    /// Trilinear; none outside the image.
    [[nodiscard]] std::optional<double> at(const Vec3& p) const {
        const Vec3 index = to_index_.topLeftCorner<3, 3>() * p + to_index_.topRightCorner<3, 1>();
        std::array<int, 3> low{};
        Vec3 share;
        for (int axis = 0; axis < 3; ++axis) {
            const double down = std::floor(index[axis]);
            const auto a = static_cast<std::size_t>(axis);
            if (!(down >= 0.0) || down + 1.0 > image_.size[a] - 1.0) return std::nullopt;
            low[a] = static_cast<int>(down);
            share[axis] = index[axis] - down;
        }
        double sum = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
            const double weight = (i ? share.x() : 1.0 - share.x()) *
                                  (j ? share.y() : 1.0 - share.y()) *
                                  (k ? share.z() : 1.0 - share.z());
            sum += weight * image_.at(low[0] + i, low[1] + j, low[2] + k);
        }
        return sum;
    }

private:
    const Image& image_;
    Eigen::Matrix4d to_index_;
};

/// A direction whose wall is known and is not a bulge's.
bool counts(const WallRing& ring, std::size_t angle) {
    return ring.distances[angle] < 1.8 * ring.radius;
}

/// The columns of the linear part: disc, disc times the squared share of the radius, 1.
Eigen::MatrixXd columns_of(const SectionProfile& profile, double radius, double blur,
                           const DiscQuestion& question) {
    const auto count = static_cast<Eigen::Index>(profile.radii.size());
    Eigen::MatrixXd columns(count, question.may_fall ? 3 : 2);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double rho = profile.radii[static_cast<std::size_t>(i)];
        const double disc = blurred_disc(rho, radius, blur);
        columns(i, 0) = disc;
        columns(i, 1) = 1.0;
        if (question.may_fall) {
            const double off = std::min(1.0, rho / radius);
            columns(i, 2) = disc * off * off;
        }
    }
    return columns;
}

DiscFit solved(const SectionProfile& profile, double radius, double blur,
               const DiscQuestion& question) {
    Eigen::MatrixXd columns = columns_of(profile, radius, blur, question);
    Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(
        profile.values.data(), static_cast<Eigen::Index>(profile.values.size()));
    DiscFit fit{.radius = radius, .blur = blur};
    if (question.contrast) {
        values -= *question.contrast * columns.col(0);
        columns = columns.rightCols(columns.cols() - 1).eval();
    }
    const Eigen::VectorXd solution = columns.colPivHouseholderQr().solve(values);
    const Eigen::Index first = question.contrast ? 0 : 1;
    fit.contrast = question.contrast ? *question.contrast : solution[0];
    fit.background = solution[first];
    fit.at_wall = fit.contrast + (question.may_fall ? solution[first + 1] : 0.0);
    fit.misfit =
        (values - columns * solution).norm() / std::sqrt(static_cast<double>(values.size()));
    return fit;
}

}  // namespace

std::optional<SectionProfile> section_profile(const Image& image,
                                              const std::vector<WallRing>& rings,
                                              const std::function<bool(const WallRing&)>& chosen,
                                              double reach) {
    SectionProfile profile;
    std::vector<double> walls;
    for (const WallRing& ring : rings)
        if (chosen(ring)) walls.push_back(ring.radius);
    if (walls.empty()) return std::nullopt;
    profile.wall = mean(walls);
    const Sampler sampler(image);
    const double step = kStep * image.spacing().minCoeff();
    for (double rho = 0.5 * step; rho < profile.wall + reach; rho += step) {
        std::vector<double> values;
        std::size_t asked = 0;
        for (const WallRing& ring : rings) {
            if (!chosen(ring)) continue;
            for (std::size_t k = 0; k < ring.distances.size(); ++k) {
                if (!counts(ring, k)) continue;
                const double own = ring.distances[k];
                const double to =
                    rho < profile.wall ? rho * own / profile.wall : own + rho - profile.wall;
                ++asked;
                if (const auto value = sampler.at(ring.centre + to * ring.direction(k)))
                    values.push_back(*value);
            }
        }
        if (2 * values.size() < asked || values.empty()) return std::nullopt;
        profile.radii.push_back(rho);
        profile.values.push_back(median(std::move(values)));
    }
    return profile;
}

double blurred_disc(double distance, double radius, double blur) {
    // Strips across the direction of the point: the Gaussian's integral over a strip is known.
    double sum = 0.0;
    const int strips = std::max(kStrips, static_cast<int>(12.0 * radius / blur));
    const double step = std::numbers::pi / strips;
    for (int i = 0; i < strips; ++i) {
        const double turn = -0.5 * std::numbers::pi + (i + 0.5) * step;
        const double x = radius * std::sin(turn), half = radius * std::cos(turn);
        const double away = (x - distance) / blur;
        sum += std::exp(-0.5 * away * away) * std::erf(half / (blur * std::numbers::sqrt2)) * half;
    }
    return sum * step / (blur * std::sqrt(2.0 * std::numbers::pi));
}

DiscFit fitted_disc(const SectionProfile& profile, const DiscQuestion& question) {
    DiscFit best{.misfit = std::numeric_limits<double>::infinity()};
    for (const double radius : question.radii)
        for (const double blur : question.blurs) {
            const DiscFit fit = solved(profile, radius, blur, question);
            if (fit.misfit < best.misfit) best = fit;
        }
    return best;
}

}  // namespace vesselbench
