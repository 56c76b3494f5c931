#include "workbench/batch/case_folder.h"

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/batch/case_record.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRunning = "batch-running";

/// \return its new place
fs::path moved_away(const BatchFolders& folders, const std::string& name) {
    make_folder(folders.earlier());
    fs::path place;
    for (int number = 1; place.empty() || fs::exists(place); ++number)
        place = folders.earlier() / (name + "." + std::to_string(number));
    fs::rename(folders.of(name), place);
    return place;
}

/// The mark last: without it, the rest would not be known as ours.
void remove_unfinished(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != kRunning) fs::remove_all(entry.path());
    fs::remove(folder / kRunning);
}

}  // namespace

fs::path begin_case(const BatchFolders& folders, const std::string& name) {
    const fs::path folder = folders.of(name);
    fs::path earlier;
    if (read_record(folder))
        earlier = moved_away(folders, name);
    else if (fs::exists(folder / kRunning))
        remove_unfinished(folder);
    else if (fs::exists(folder) && !fs::is_empty(folder))
        throw IoError("'" + name + "' in '" + bare_name(folder.parent_path()) +
                      "' exists and is not of a batch: give another --out, or the case another "
                      "name");
    make_folder(folder);
    write_file(folder / kRunning, "");
    return earlier;
}

void end_case(const BatchFolders& folders, const std::string& name) {
    std::error_code ignored;
    fs::remove(folders.of(name) / kRunning, ignored);
}

}  // namespace vesselbench
