#include "workbench/window/case/user_folders.h"

#include <cstdlib>
#include <string>

#include <unistd.h>

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

fs::path from_environment(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? fs::path() : fs::path(text);
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

/// The name without the suffixes of compressed images: "scan.nii.gz" is "scan".
std::string plain_stem(const fs::path& input) {
    fs::path name = input.has_filename() ? input.filename() : input.parent_path().filename();
    if (name.extension() == ".gz") name = name.stem();
    if (!is_folder(input)) name = name.stem();
    return name.empty() ? "case" : name.string();
}

/// "a-2.png" of "a.png".
std::string numbered(const fs::path& file, int number) {
    return file.stem().string() + "-" + std::to_string(number) + file.extension().string();
}

/// Where the first project of an input goes.
fs::path project_place(const fs::path& input, bool beside, const fs::path& otherwise) {
    const fs::path parent = (input.has_filename() ? input : input.parent_path()).parent_path();
    const fs::path near = parent.empty() ? fs::path(".") : parent;
    const fs::path folder = beside && is_writable_folder(near) ? near : otherwise;
    return folder / (plain_stem(input) + ".vbench");
}

}  // namespace

fs::path home_folder() {
    const fs::path home = from_environment("HOME");
    return home.empty() ? fs::path("/") : home;
}

fs::path settings_folder() {
    const fs::path given = from_environment("XDG_CONFIG_HOME");
    return (given.empty() ? home_folder() / ".config" : given) / "vesselbench";
}

fs::path cache_folder() {
    const fs::path given = from_environment("XDG_CACHE_HOME");
    return (given.empty() ? home_folder() / ".cache" : given) / "vesselbench";
}

fs::path state_folder() {
    const fs::path given = from_environment("XDG_STATE_HOME");
    return (given.empty() ? home_folder() / ".local" / "state" : given) / "vesselbench";
}

fs::path documents_folder() {
    const fs::path given = from_environment("XDG_DOCUMENTS_DIR");
    if (is_folder(given)) return given;
    const fs::path usual = home_folder() / "Documents";
    return is_folder(usual) ? usual : home_folder();
}

bool is_writable_folder(const fs::path& folder) {
    return is_folder(folder) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

fs::path free_file(const fs::path& wanted) {
    fs::path file = wanted;
    std::error_code error;
    for (int number = 2; fs::exists(file, error); ++number)
        file.replace_filename(numbered(wanted, number));
    return file;
}

fs::path new_project_file(const fs::path& input, bool beside, const fs::path& otherwise) {
    return free_file(project_place(input, beside, otherwise));
}

std::vector<fs::path> earlier_project_files(const fs::path& input, bool beside,
                                            const fs::path& otherwise) {
    const fs::path first = project_place(input, beside, otherwise), next = free_file(first);
    std::vector<fs::path> files;
    std::error_code error;
    fs::path file = first;
    for (int number = 2; file != next && fs::is_regular_file(file, error); ++number) {
        files.insert(files.begin(), file);
        file.replace_filename(numbered(first, number));
    }
    return files;
}

}  // namespace vesselbench
