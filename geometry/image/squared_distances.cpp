#include "geometry/image/squared_distances.h"

#include <cstddef>
#include <limits>

namespace vesselbench {

void squared_distances(std::vector<float>& line, double h) {
    const std::size_t n = line.size();
    std::vector<std::size_t> parabola(n);
    std::vector<double> from(n + 1);
    const auto meet = [&](std::size_t p, std::size_t q) {  // p < q
        const double a = h * static_cast<double>(p), b = h * static_cast<double>(q);
        return ((line[q] + b * b) - (line[p] + a * a)) / (2.0 * (b - a));
    };
    std::size_t count = 0;
    for (std::size_t q = 0; q < n; ++q) {
        if (line[q] >= kFarSquared) continue;
        while (count > 0 && meet(parabola[count - 1], q) <= from[count - 1]) --count;
        from[count] =
            count == 0 ? -std::numeric_limits<double>::infinity() : meet(parabola[count - 1], q);
        parabola[count++] = q;
    }
    if (count == 0) return;
    const std::vector<float> old = line;
    std::size_t at = 0;
    for (std::size_t p = 0; p < n; ++p) {
        const double x = h * static_cast<double>(p);
        while (at + 1 < count && from[at + 1] < x) ++at;
        const double d = x - h * static_cast<double>(parabola[at]);
        line[p] = static_cast<float>(d * d + old[parabola[at]]);
    }
}

}  // namespace vesselbench
