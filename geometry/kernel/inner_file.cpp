#include "geometry/kernel/inner_file.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestShown = 200;  // bytes of a path in an error text

std::string quoted(const fs::path& path) {
    return "'" + shortened(printable(path.string()), kLongestShown) + "'";
}

/// The path without links, "." and ".."; empty if a link leads to itself or may not be followed.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    fs::path real = fs::weakly_canonical(path, error);
    return error ? fs::path() : real;
}

}  // namespace

fs::path inner_file(const fs::path& folder, const fs::path& named, const std::string& what) {
    const fs::path inside = folder.empty() ? fs::path(".") : folder;
    const fs::path real_folder = resolved(inside), real_file = resolved(inside / named);
    if (real_folder.empty() || real_file.empty())
        throw InvalidInput(what + " " + quoted(named) +
                           " cannot be followed to a file: replace it by the file itself");
    if (std::ranges::mismatch(real_folder, real_file).in1 != real_folder.end())
        throw InvalidInput(what + " " + quoted(named) + " is " + quoted(real_file) +
                           ", outside the folder that it has to be in: copy it there");
    return folder / named;
}

}  // namespace vesselbench
