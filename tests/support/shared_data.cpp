#include <filesystem>

#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

namespace vesselbench::test {

std::string shared_data(const std::string& name) {
    const auto path =
        std::filesystem::path(test::source_folder()).parent_path() / "shared" / "data" / name;
    if (std::filesystem::exists(path)) return path.string();
    skip("no ../shared/data/" + name);
    return {};
}

}  // namespace vesselbench::test
