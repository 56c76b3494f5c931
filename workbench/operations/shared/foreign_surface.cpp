#include "workbench/operations/shared/foreign_surface.h"

#include "geometry/formats/length_unit.h"
#include "workbench/operations/table.h"
#include "workbench/worker/run_operation.h"

namespace vesselbench {

Surface read_foreign_surface(const std::string& file, const std::string& units,
                             const Progress& progress) {
    Arguments arguments;
    arguments.set("file", file);
    arguments.set("units", to_string(length_unit_from(units.empty() ? "mm" : units)));
    Progress reading = progress;
    const Operation& load = loading_operation(InputKind::Surface);
    return *run_operation(load, {}, arguments, reading).scene.surface;
}

}  // namespace vesselbench
