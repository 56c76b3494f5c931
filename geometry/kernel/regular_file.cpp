#include "geometry/kernel/regular_file.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

void refuse_special_file(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_other(status))
        throw IoError(bare_name(path) +
                      " is a device, a pipe or a socket: copy what it holds to a file first");
}

}  // namespace vesselbench
