#include "workbench/operations/table.h"

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "workbench/case/near_names.h"

namespace vesselbench {

std::span<const Operation> operation_table() {
#define VESSELBENCH_ROW(name) name##_operation(),
    static const std::vector<Operation> table = {VESSELBENCH_OPERATIONS(VESSELBENCH_ROW)};
#undef VESSELBENCH_ROW
    return table;
}

const Operation* known_operation(const std::string& name) {
    const auto found = std::ranges::find(operation_table(), name, &Operation::name);
    return found == operation_table().end() ? nullptr : &*found;
}

const Operation& find_operation(const std::string& name) {
    if (const Operation* known = known_operation(name)) return *known;
    std::vector<std::string> names;
    for (const Operation& operation : operation_table()) names.push_back(operation.name);
    throw UsageError("there is no operation '" + name + "'" + did_you_mean(name, names) +
                     " ('vesselbench operations' lists them all)");
}

const Operation& loading_operation(InputKind kind) {
    return *std::ranges::find_if(operation_table(), [&](const Operation& operation) {
        return operation.recipe.loads == kind;
    });
}

const Operation& extracting_operation() {
    return *std::ranges::find_if(operation_table(), [](const Operation& operation) {
        return operation.recipe.makes_source && !operation.recipe.loads;
    });
}

}  // namespace vesselbench
