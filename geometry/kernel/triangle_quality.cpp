#include "geometry/kernel/triangle_quality.h"

#include <cmath>
#include <limits>

#include "geometry/kernel/triangle_shape.h"

namespace vesselbench {

std::vector<double> worst_triangle_quality(const Surface& surface) {
    std::vector<double> worst(surface.vertex_count(), std::numeric_limits<double>::quiet_NaN());
    const Positions& x = surface.points();
    for (const Triangle& t : surface.triangles()) {
        const double ratio = radius_ratio(x[t[0]], x[t[1]], x[t[2]]);
        for (const VertexId v : t) worst[v] = std::fmin(worst[v], ratio);
    }
    return worst;
}

}  // namespace vesselbench
