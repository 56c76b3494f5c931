#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "geometry/kernel/robust.h"

namespace vesselbench {

/// A point of the wall beside a line, in any unit of length.
struct TubeSample {
    double along = 0.0;     ///< place on the line
    double angle = 0.0;     ///< around the line [rad]
    double distance = 0.0;  ///< from the line
    Eigen::Vector2d out;    ///< unit, from the line to the point, by the axes of the line's offsets
};

/// How a wall's points are weighed against each other, and against what is known before.
struct TubeWeights {
    int rounds = 5;                     ///< at least 1; the first one weighs all points alike
    double deviation = kNormalScatter;  ///< of a median absolute deviation: its standard deviation
    double reach = kTukeyReach;         ///< a point farther off does not count [deviations]
    double least = 0.0;                 ///< smallest standard deviation [lengths]
    double alike = 1.0;  ///< times a point's variance, where neighbours' errors are alike [-]
    /// Where nothing is known before: chooses the smallest of the unknowns that fit points which do
    /// not determine them, such as two rings; of the largest diagonal element of their normal
    /// matrix.
    double ridge = 0.0;
};

/// The tube around a line that fits a stretch of wall: offsets of the line along two axes, each of
/// so many `Powers` of the place along it; a radius of degree 2; and the outline's cosine and sine
/// of the second harmonic on, `Shape` numbers. Linear least squares in which points far off count
/// less (Tukey's biweight). Source: Holland, Welsch, "Robust regression using iteratively
/// reweighted least-squares", 1977.
template <int Powers, int Shape>
struct TubeFit {
    static constexpr int kRadius = 3, kRadiusAt = 2 * Powers, kShapeAt = kRadiusAt + kRadius;
    static constexpr int kUnknowns = kShapeAt + Shape;
    using Series = Eigen::Matrix<double, 1, Powers>;
    using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
    using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

    Unknowns unknowns;
    Normal spread;           ///< covariance of the unknowns
    Eigen::VectorXd rest;    ///< what is left of each sample's distance
    double scatter = 0.0;    ///< weighted root mean square of the rest
    double deviation = 0.0;  ///< robust standard deviation of the rest
    /// False if neither the points nor what is known determine the unknowns: the rest means
    /// nothing.
    bool determined = true;

    /// \param samples more than kUnknowns \param first a guess of their scatter, > 0
    /// \param known inverse variances of the unknowns before \param means of them, times these
    TubeFit(std::span<const TubeSample> samples, double first, const TubeWeights& how,
            const Normal& known, const Unknowns& means)
        : scatter(first) {
        const auto count = static_cast<Eigen::Index>(samples.size());
        Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> rows(count, kUnknowns);
        Eigen::VectorXd distances(count), weights = Eigen::VectorXd::Ones(count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const TubeSample& sample = samples[static_cast<std::size_t>(i)];
            const Series along = powers(sample.along);
            distances[i] = sample.distance;
            rows.row(i) << sample.out.x() * along, sample.out.y() * along,
                along.template head<kRadius>(), harmonics(sample.angle);
        }
        for (int round = 0; round < how.rounds; ++round) {
            const double each = 1.0 / (how.alike * scatter * scatter);
            const Normal data = each * rows.transpose() * weights.asDiagonal() * rows;
            const double ridge = how.ridge * data.diagonal().maxCoeff();
            const Unknowns right = each * rows.transpose() * weights.cwiseProduct(distances);
            const Eigen::LLT<Normal> solver(data + known + ridge * Normal::Identity());
            determined = solver.info() == Eigen::Success;
            if (!determined) return;
            spread = solver.solve(Normal::Identity());
            unknowns = solver.solve(right + means);
            rest = distances - rows * unknowns;
            // Unknowns that the points determine, not what is known before.
            const double free = weights.sum() - (data * spread).trace();
            scatter = std::max(
                std::sqrt(weights.dot(rest.cwiseAbs2()) / std::max(free, 0.15 * weights.sum())),
                how.least);
            deviation =
                std::max(how.deviation * median_deviation({rest.begin(), rest.end()}), how.least);
            for (Eigen::Index i = 0; i < count; ++i)
                weights[i] = biweight(rest[i], how.reach * deviation);
        }
    }

    [[nodiscard]] static Series powers(double t) {
        Series row;
        double p = 1.0;
        for (Eigen::Index k = 0; k < Powers; ++k, p *= t) row[k] = p;
        return row;
    }

    [[nodiscard]] static Eigen::Matrix<double, 1, Shape> harmonics(double angle) {
        Eigen::Matrix<double, 1, Shape> row;
        for (int k = 0; k < Shape; ++k) {
            const int order = 2 + k / 2;
            row[k] = k % 2 == 0 ? std::cos(order * angle) : std::sin(order * angle);
        }
        return row;
    }
};

}  // namespace vesselbench
