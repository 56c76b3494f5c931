#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench::forest {

/// Random numbers that are the same with any standard library: the engine is specified by the C++
/// standard, the distributions are ours.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1).
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

    double between(double low, double high) { return low + (high - low) * unit(); }

    /// Uniform in the logarithm.
    double log_between(double low, double high) {
        return low * std::exp(unit() * std::log(high / low));
    }

    /// A whole number from low to high, both included.
    int whole(int low, int high) {
        return std::min(high, low + static_cast<int>(unit() * (high - low + 1)));
    }

    bool chance(double probability) { return unit() < probability; }

    /// Standard normal (Box and Muller 1958).
    double normal() {
        const double a = 1.0 - unit(), b = unit();
        return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
    }

    /// An index, with probabilities in proportion to the weights.
    std::size_t pick(const std::vector<double>& weights) {
        double sum = 0.0;
        for (const double weight : weights) sum += weight;
        double left = unit() * sum;
        for (std::size_t i = 0; i + 1 < weights.size(); ++i)
            if ((left -= weights[i]) < 0.0) return i;
        return weights.size() - 1;
    }

    /// A unit vector, uniform on the sphere.
    Vec3 direction() {
        const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

    /// A unit vector across `axis`.
    Vec3 across(const Vec3& axis) {
        Vec3 found = direction().cross(axis);
        while (found.norm() < 0.1) found = direction().cross(axis);
        return found.normalized();
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace vesselbench::forest
