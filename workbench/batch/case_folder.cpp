#include "workbench/batch/case_folder.h"

#include <chrono>
#include <fstream>
#include <thread>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "workbench/batch/case_record.h"
#include "workbench/batch/case_report.h"
#include "workbench/prepare/case_files.h"
#include "workbench/project/file_lock.h"

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

/// In one step, without a temporary file: killed within, it would leave a folder that is not known
/// as ours.
void mark(const fs::path& folder) {
    if (!std::ofstream(folder / kRunning))
        throw IoError("'" + bare_name(folder) + "' cannot be written");
}

/// The mark last: without it, the rest would not be known as ours.
void remove_unfinished(const fs::path& folder) {
    if (!fs::exists(folder / kRunning)) return;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != kRunning) fs::remove_all(entry.path());
    fs::remove(folder / kRunning);
}

/// What shows that a batch is at a case.
void remove_marks(const fs::path& folder) {
    static_cast<void>(FileLock::acquire(folder / kProjectFile));  // given back, it is removed
    remove_abandoned(folder);
    std::error_code ignored;
    fs::remove(folder / kRunning, ignored);
}

/// The processes of a killed batch are gone a moment after it: their memory is given back first.
constexpr std::chrono::milliseconds kLongestEnd(5000), kLockRetry(20);

/// So that no window or command has the project that is moved away.
/// \throw IoError if one has; no lock where there is no project
FileLock::Attempt project_lock(const fs::path& folder) {
    if (!fs::exists(folder / kProjectFile)) return {};
    FileLock::Attempt attempt = FileLock::acquire(folder / kProjectFile);
    const auto end = std::chrono::steady_clock::now() + kLongestEnd;
    while (attempt.lock == nullptr && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(kLockRetry);
        attempt = FileLock::acquire(folder / kProjectFile);
    }
    if (attempt.lock == nullptr)
        throw IoError("'" + bare_name(folder) + "' cannot be prepared again: " + attempt.reason);
    return attempt;
}

}  // namespace

fs::path begin_case(const BatchFolders& folders, const std::string& name) {
    const fs::path folder = folders.of(name);
    fs::path earlier;
    FileLock::Attempt writing = project_lock(folder);
    const bool is_ours = fs::exists(folder / kRunning);
    if (has_record(folder) || (is_ours && !read_report(folder).is_null())) {
        earlier = moved_away(folders, name);  // a person may have finished what was killed
        writing.lock.reset();                 // its file went along
        remove_marks(earlier);
    } else if (is_ours) {
        remove_unfinished(folder);
    } else if (fs::exists(folder) && !fs::is_empty(folder)) {
        throw IoError("'" + name + "' in '" + bare_name(folder.parent_path()) +
                      "' exists and is not of a batch: give another --out, or the case another "
                      "name");
    }
    make_folder(folder);
    mark(folder);
    return earlier;
}

void end_case(const BatchFolders& folders, const std::string& name) {
    remove_marks(folders.of(name));
}

void drop_case(const BatchFolders& folders, const std::string& name) {
    try {
        remove_unfinished(folders.of(name));
        fs::remove(folders.of(name));
    } catch (const fs::filesystem_error&) {  // its mark says that it is unfinished
    }
}

}  // namespace vesselbench
