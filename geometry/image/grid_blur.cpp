#include "geometry/image/grid_blur.h"

#include <algorithm>
#include <cmath>

#include "geometry/image/lines.h"

namespace vesselbench {

namespace {

/// Three boxes are as good as a Gaussian from here on, and take the same time for any width
/// [voxels].
constexpr double kWide = 2.5;

/// exp(-t) I_n(t) of n = 0, 1, ... for the variance t.
std::vector<float> discrete_gaussian(double variance) {
    constexpr double kCut = 1e-5;
    std::vector<float> kernel;
    for (int n = 0;; ++n) {
        const double weight = std::exp(-variance) * std::cyl_bessel_i(n, variance);
        kernel.push_back(static_cast<float>(weight));
        if (weight < kCut && n > 0) return kernel;
    }
}

/// From the first value that is not 0 to beyond the last; a vessel fills little of a line.
struct Stretch {
    long first = 0, end = 0;
};

Stretch filled_stretch(const std::vector<float>& line) {
    const auto filled = [](float value) { return value != 0.0f; };
    const auto first = std::ranges::find_if(line, filled);
    if (first == line.end()) return {};
    const auto last = std::find_if(line.rbegin(), line.rend(), filled);
    return {first - line.begin(), line.rend() - last};
}

/// A box of a fractional width, whose ends count by a part.
struct Box {
    long reach = 0;    ///< voxels on each side that count whole
    double end = 0.0;  ///< weight of the next one

    [[nodiscard]] double width() const {
        return 2.0 * static_cast<double>(reach) + 1.0 + 2.0 * end;
    }
};

/// The box with a third of a variance, exactly.
/// Source: Gwosdek, Grewenig, Bruhn, Weickert, "Theoretical foundations of Gaussian convolution by
/// extended box filtering", SSVM 2011.
Box third_of(double variance) {
    const double v = variance / 3.0;
    Box box;
    box.reach = static_cast<long>(std::floor(0.5 * std::sqrt(12.0 * v + 1.0) - 0.5));
    const auto r = static_cast<double>(box.reach);
    box.end = (2.0 * r + 1.0) * (r * (r + 1.0) - 3.0 * v) / (6.0 * (v - (r + 1.0) * (r + 1.0)));
    return box;
}

/// Running sums in double: what they gather in rounding is far below single precision.
void box_mean(std::vector<float>& line, std::vector<float>& old, const Box& box,
              const Stretch& filled) {
    const auto n = static_cast<long>(line.size());
    old = line;
    const auto at = [&](long i) -> double {
        return old[static_cast<std::size_t>(std::clamp(i, 0L, n - 1))];
    };
    const long first = std::max(0L, filled.first - box.reach - 1);
    const long end = std::min(n, filled.end + box.reach + 1);
    double sum = 0.0;
    for (long i = first - box.reach; i <= first + box.reach; ++i) sum += at(i);
    const double scale = 1.0 / box.width();
    for (long i = first; i < end; ++i) {
        const double before = at(i - box.reach - 1), after = at(i + box.reach + 1);
        line[static_cast<std::size_t>(i)] =
            static_cast<float>(scale * (sum + box.end * (before + after)));
        sum += after - at(i - box.reach);
    }
}

void convolve_line(std::vector<float>& line, std::vector<float>& old,
                   const std::vector<float>& kernel, const Stretch& filled) {
    const auto n = static_cast<long>(line.size()), reach = static_cast<long>(kernel.size()) - 1;
    old.resize(line.size() + 2 * static_cast<std::size_t>(reach));
    std::fill_n(old.begin(), reach, line.front());
    std::ranges::copy(line, old.begin() + reach);
    std::fill_n(old.end() - reach, reach, line.back());
    const long end = std::min(n, filled.end + reach);
    for (long i = std::max(0L, filled.first - reach); i < end; ++i) {
        const float* at = old.data() + i + reach;
        float sum = kernel[0] * at[0];
        for (long d = 1; d <= reach; ++d)
            sum += kernel[static_cast<std::size_t>(d)] * (at[-d] + at[d]);
        line[static_cast<std::size_t>(i)] = sum;
    }
}

}  // namespace

void blur_grid(std::vector<float>& values, const std::array<int, 3>& size, const Vec3& sigma) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(sigma[axis] > 0.0)) continue;
        const double variance = sigma[axis] * sigma[axis];
        const bool wide = sigma[axis] >= kWide;
        const std::vector<float> kernel = wide ? std::vector<float>() : discrete_gaussian(variance);
        const Box box = third_of(variance);
        for_each_line(values, size, axis, [&](std::vector<float>& line) {
            thread_local std::vector<float> old;
            for (int pass = 0; pass < (wide ? 3 : 1); ++pass) {
                const Stretch filled = filled_stretch(line);
                if (filled.first == filled.end) return;
                if (wide)
                    box_mean(line, old, box, filled);
                else
                    convolve_line(line, old, kernel, filled);
            }
        });
    }
}

}  // namespace vesselbench
