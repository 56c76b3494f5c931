#include "meshing/tetrahedra/tetgen_failure.h"

#include <algorithm>

#include "geometry/kernel/wording.h"

namespace vesselbench {

std::string tetgen_error_text(int code) {
    switch (code) {
        case 1:
            return "out of memory";
        case 2:
            return "internal error of TetGen";
        case 3:
            return "two facets of the surface intersect";
        case 4:
            return "a feature of the surface is too small for the tolerance";
        case 5:
            return "two facets of the surface nearly coincide";
        case 10:
            return "TetGen does not accept the surface as input";
        default:
            return "TetGen stopped with code " + std::to_string(code);
    }
}

Diagnostic tetgen_failure(const Surface& surface, std::span<const std::string> attempts,
                          std::span<const TriangleId> intersecting) {
    constexpr std::size_t kMostListed = 5;
    Diagnostic failure{.code = "not-filled",
                       .operation = "tetrahedralize",
                       .remedies = {{.operation = "repair"}, {.operation = "remesh"}}};
    std::string tried;
    for (const std::string& attempt : attempts) tried += "\n  " + attempt;
    for (const TriangleId t : intersecting.first(std::min(kMostListed, intersecting.size()))) {
        const auto& [a, b, c] = surface.triangles()[t];
        const Vec3 centre = (surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0;
        if (!failure.place) failure.place = centre;
        tried += "\n  facet " + std::to_string(t) + " at " + place_text(centre) +
                 " intersects another one";
    }
    failure.words["attempts"] = tried;
    return failure;
}

}  // namespace vesselbench
