#include "tests/workbench/test_operations.h"

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

}  // namespace vesselbench::test
