#include "workbench/operations/shared/foreign_surface.h"

#include "geometry/formats/length_unit.h"
#include "workbench/operations/table.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

std::string assumed_units(const std::string& given) {
    return given.empty() ? "mm" : given;
}

Surface read_foreign_surface(const std::string& file, const std::string& units,
                             const Progress& progress) {
    const Operation& load = loading_operation(InputKind::Surface);
    GivenArguments given(load);
    given.set("file", file);
    given.set("units", to_string(length_unit_from(assumed_units(units))));
    Progress reading = progress;
    return *run_operation(load, {}, checked_arguments(given), reading).scene.surface;
}

}  // namespace vesselbench
