#include "workbench/operations/table.h"

#include <vector>

namespace vesselbench {

std::span<const Operation> operation_table() {
    static const std::vector<Operation> table = {
        smooth_operation(),
    };
    return table;
}

}  // namespace vesselbench
