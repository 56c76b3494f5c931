#include "geometry/kernel/bare_name.h"

namespace vesselbench {

std::string bare_name(const std::filesystem::path& path) {
    const std::filesystem::path normal = path.lexically_normal();
    return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

}  // namespace vesselbench
