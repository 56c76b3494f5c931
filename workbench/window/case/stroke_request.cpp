#include "workbench/window/case/stroke_request.h"

namespace vesselbench {

bool is_brush(const Operation& operation) {
    return operation.start != nullptr && parameter_of(operation, Meaning::Dabs) != nullptr;
}

}  // namespace vesselbench
