#include "tests/support/paths.h"

namespace vesselbench::test {

// The only source that is compiled with absolute paths: the compiler cache then serves every
// checkout.
std::string source_folder() {
    return VESSELBENCH_SOURCE_DIR;
}

std::string program_path() {
    return VESSELBENCH_BINARY;
}

}  // namespace vesselbench::test
