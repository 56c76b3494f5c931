#include "workbench/case/version.h"

namespace vesselbench {

std::string version() {
    return VESSELBENCH_VERSION;
}

}  // namespace vesselbench
