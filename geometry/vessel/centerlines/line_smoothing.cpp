#include "geometry/vessel/centerlines/line_smoothing.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "geometry/kernel/robust.h"

namespace vesselbench {
namespace {

/// The line with arc lengths; a closed one is extended by a part of itself at both ends.
struct Unrolled {
    std::vector<double> s;
    std::vector<std::size_t> source;  ///< index of the line's point
    std::size_t first = 0;            ///< position of the line's point 0
};

Unrolled unroll(const Line& line) {
    const std::size_t n = line.points.size();
    const std::size_t extra = line.closed ? n / 2 : 0;
    Unrolled u;
    u.first = extra;
    for (std::size_t i = 0; i < n + 2 * extra; ++i) u.source.push_back((i + n - extra) % n);
    u.s.push_back(0.0);
    for (std::size_t i = 1; i < u.source.size(); ++i) {
        u.s.push_back(u.s.back() +
                      (line.points[u.source[i]] - line.points[u.source[i - 1]]).norm());
    }
    return u;
}

/// Weighted sums of the regression in u = (s - centre) / window.
struct Regression {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 4> b = Eigen::Matrix<double, 3, 4>::Zero();
    int count = 0;

    void add(double u, double weight, const Vec3& p, double radius) {
        const Vec3 basis(1.0, u, u * u);
        A += weight * basis * basis.transpose();
        b.leftCols<3>() += weight * basis * p.transpose();
        b.col(3) += weight * basis * radius;
        ++count;
    }
};

LineFit fit_at(const Line& line, const Unrolled& un, std::size_t at, double window) {
    Regression r;
    const Vec3 origin = line.points[un.source[at]];
    const auto add = [&](std::size_t i) {
        const double u = (un.s[i] - un.s[at]) / window;
        if (std::abs(u) >= 1.0) return false;
        const std::size_t k = un.source[i];
        r.add(u, biweight(u, 1.0) * line.weights[k], line.points[k] - origin, line.radii[k]);
        return true;
    };
    add(at);
    for (std::size_t i = at; i-- > 0 && add(i);) {
    }
    for (std::size_t i = at + 1; i < un.s.size() && add(i); ++i) {
    }
    LineFit fit{origin, Vec3::UnitZ(), Vec3::Zero(), line.radii[un.source[at]]};
    if (r.count < 4) {
        const std::size_t a = at > 0 ? at - 1 : at;
        const std::size_t b = std::min(at + 1, un.s.size() - 1);
        fit.tangent = (line.points[un.source[b]] - line.points[un.source[a]]).normalized();
        return fit;
    }
    const Eigen::Matrix<double, 3, 4> x = r.A.ldlt().solve(r.b);
    const auto way = x.leftCols<3>();
    if (!x.allFinite() || !(way.row(1).norm() > 0.0)) return fit;
    fit.point = origin + way.row(0).transpose();
    fit.tangent = way.row(1).transpose().normalized();
    fit.curvature = 2.0 * way.row(2).transpose() / (window * window);
    fit.radius = x(0, 3);
    fit.curvature -= fit.curvature.dot(fit.tangent) * fit.tangent;
    return fit;
}

}  // namespace

std::vector<LineFit> fit_line(const Line& line, double window, double least) {
    const Unrolled un = unroll(line);
    std::vector<LineFit> fits;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const std::size_t at = un.first + i;
        const double step =
            (un.s[std::min(at + 1, un.s.size() - 1)] - un.s[at > 0 ? at - 1 : at]) / 2.0;
        fits.push_back(fit_at(line, un, at, std::max({window * line.radii[i], least, 3.5 * step})));
    }
    return fits;
}

double line_length(const Line& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        length += (line.points[i] - line.points[i - 1]).norm();
    }
    if (line.closed) length += (line.points.front() - line.points.back()).norm();
    return length;
}

Line resampled(const Line& line, double spacing, std::size_t fewest) {
    Line open = line;
    if (line.closed) {
        open.points.push_back(line.points.front());
        open.radii.push_back(line.radii.front());
    }
    // The measure in which new points are equidistant: arc length over local radius.
    const double smallest = 1e-3 * *std::max_element(open.radii.begin(), open.radii.end());
    std::vector<double> measure{0.0};
    for (std::size_t i = 1; i < open.points.size(); ++i) {
        const double radius = std::max(0.5 * (open.radii[i] + open.radii[i - 1]), smallest);
        measure.push_back(measure.back() +
                          (open.points[i] - open.points[i - 1]).norm() / (spacing * radius));
    }
    const auto steps = std::max(fewest - 1, static_cast<std::size_t>(std::ceil(measure.back())));
    Line result;
    result.closed = line.closed;
    std::size_t k = 0;
    for (std::size_t i = 0; i < (line.closed ? steps : steps + 1); ++i) {
        const double m = measure.back() * static_cast<double>(i) / static_cast<double>(steps);
        while (k + 2 < measure.size() && measure[k + 1] < m) ++k;
        const double step = measure[k + 1] - measure[k];
        const double f = step > 0.0 ? std::clamp((m - measure[k]) / step, 0.0, 1.0) : 0.0;
        result.points.push_back((1.0 - f) * open.points[k] + f * open.points[k + 1]);
        result.radii.push_back((1.0 - f) * open.radii[k] + f * open.radii[k + 1]);
        result.weights.push_back(1.0);
    }
    return result;
}

}  // namespace vesselbench
