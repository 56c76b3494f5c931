#include "workbench/batch/file_digests.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/errors.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string state_of_file(const fs::path& file) {
    return std::to_string(fs::file_size(file)) + " " +
           std::to_string(fs::last_write_time(file).time_since_epoch().count());
}

/// Names, sizes and times. \throw filesystem_error
std::string state_of(const fs::path& path) {
    if (!fs::is_directory(path)) return state_of_file(path);
    std::vector<std::string> lines;
    for (const auto& entry : fs::recursive_directory_iterator(path))
        if (entry.is_regular_file())
            lines.push_back(entry.path().lexically_relative(path).string() + " " +
                            state_of_file(entry.path()) + "\n");
    std::ranges::sort(lines);
    std::string text;
    for (const std::string& line : lines) text += line;
    return hash_of_text(text);
}

}  // namespace

std::string FileDigests::next(const fs::path& path) {
    const std::size_t number = asked_.size();
    Json file = {{"state", ""}, {"sha256", "missing"}};
    try {
        file["state"] = hash_of_text(fs::absolute(path).string() + " " + state_of(path));
        const bool same = known_.is_array() && number < known_.size() &&
                          known_[number].is_object() &&
                          known_[number].value("state", Json()) == file["state"];
        file["sha256"] = same ? known_[number].value("sha256", Json("")) : Json(hash_of_file(path));
    } catch (const fs::filesystem_error&) {
    } catch (const IoError&) {
    }
    asked_.push_back(file);
    return file["sha256"].is_string() ? file["sha256"].get<std::string>() : "missing";
}

}  // namespace vesselbench
