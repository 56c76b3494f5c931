#include "workbench/review/known_operation.h"

#include "geometry/kernel/errors.h"

namespace vesselbench {

const Operation* known_operation(const OperationLookup& find, const std::string& name) {
    try {
        return &find(name);
    } catch (const UsageError&) {
        return nullptr;
    }
}

}  // namespace vesselbench
