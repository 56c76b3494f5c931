#include "geometry/kernel/regular_file.h"

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

fs::file_status status_of(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::status_known(status)) return status;  // also of what does not exist
    if (error == std::errc::too_many_symbolic_link_levels)
        throw IoError(bare_name(path) + " is a link that leads to itself: give the file itself");
    throw IoError(bare_name(path) + " cannot be reached (" + error.message() +
                  "): check its name and the permissions of its folders");
}

}  // namespace

bool file_exists(const fs::path& path) {
    return fs::exists(status_of(path));
}

void refuse_special_file(const fs::path& path) {
    if (fs::is_other(status_of(path)))
        throw IoError(bare_name(path) +
                      " is a device, a pipe or a socket: copy what it holds to a file first");
}

}  // namespace vesselbench
