#include "workbench/prepare/bundled_cases.h"

#include "geometry/kernel/bare_name.h"
#include "workbench/prepare/case_files.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaces[] = {"cases", "share/vesselbench/cases"};

}  // namespace

fs::path own_folder(std::span<const char* const> places, const fs::path& content) {
    std::error_code error;
    fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (; !error && folder != folder.root_path(); folder = folder.parent_path())
        for (const char* place : places)
            if (fs::exists(folder / place / content, error)) return folder / place;
    return {};
}

fs::path bundled_cases_folder() {
    return own_folder(kPlaces, fs::path("aneurysm") / kCaseFile);
}

fs::path bundled_case(const std::string& name) {
    if (name.empty() || bare_name(name) != name) return {};
    const fs::path folder = bundled_cases_folder();
    std::error_code error;
    return !folder.empty() && fs::exists(folder / name / kCaseFile, error) ? folder / name : "";
}

}  // namespace vesselbench
