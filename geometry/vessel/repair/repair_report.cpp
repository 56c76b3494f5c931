#include "geometry/vessel/repair/repair_report.h"

#include <array>

namespace vesselbench {

std::string to_string(RepairKind kind) {
    constexpr const char* names[] = {
        "welded",      "degenerate",        "duplicate", "component", "non-manifold",
        "orientation", "self-intersection", "hole",      "short-edge"};
    return names[static_cast<int>(kind)];
}

bool RepairReport::changed() const {
    return welded_vertices + unused_vertices + degenerate_triangles + duplicate_triangles +
                   removed_components + non_manifold_edges + non_manifold_vertices +
                   turned_triangles + self_intersections + closed_holes + collapsed_edges +
                   flipped_edges >
               0 ||
           turned_inside_out;
}

}  // namespace vesselbench
