#include "meshing/remeshing/carried_attributes.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/vertex_fields.h"

namespace vesselbench {

Surface with_attributes_of(const Surface& source, Surface result) {
    if (source.attributes.empty()) return result;
    const SurfaceDistance search = distance_to(source);
    std::map<std::string, std::vector<double>> values;
    for (const Vec3& p : result.points()) {
        const SurfacePoint at = search.closest_point(p);
        const Triangle& triangle = source.triangles()[at.triangle];
        const Vec3 weights = barycentric(source.points(), triangle, at.point);
        for (const auto& [name, field] : source.attributes)
            values[name].push_back(weights[0] * (*field)[triangle[0]] +
                                   weights[1] * (*field)[triangle[1]] +
                                   weights[2] * (*field)[triangle[2]]);
    }
    for (auto& [name, field] : values)
        result.attributes[name] = std::make_shared<const std::vector<double>>(std::move(field));
    return result;
}

}  // namespace vesselbench
