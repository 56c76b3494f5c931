#include "tests/workbench/test_operations.h"

#include <algorithm>

#include "workbench/operations/table.h"

namespace vesselbench::test {

Outcome run(const std::string& operation, const Scene& scene, const Arguments& arguments) {
    Progress progress;
    const Operation& found = find_operation(operation);
    return run_here(found, scene, checked_arguments(found, arguments), progress);
}

Outcome run(const std::string& operation, const Surface& surface, const Arguments& arguments) {
    Scene scene;
    scene.surface = surface;
    return run(operation, scene, arguments);
}

std::size_t moved_vertices(const Surface& before, const Surface& after) {
    std::size_t moved = 0;
    for (VertexId v = 0; v < before.vertex_count(); ++v)
        if (after.points()[v] != before.points()[v]) ++moved;
    return moved;
}

double longest_way(const Surface& before, const Surface& after) {
    double longest = 0.0;
    for (VertexId v = 0; v < before.vertex_count(); ++v)
        longest = std::max(longest, (after.points()[v] - before.points()[v]).norm());
    return longest;
}

}  // namespace vesselbench::test
