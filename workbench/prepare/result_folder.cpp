#include "workbench/prepare/result_folder.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"
#include "workbench/export/products.h"

namespace vesselbench {

namespace fs = std::filesystem;

ResultFolder::ResultFolder(fs::path path) : path_(std::move(path)), is_new_(!fs::exists(path_)) {
    make_folder(path_);
}

ResultFolder::~ResultFolder() {
    std::error_code ignored;
    if (is_new_) fs::remove(path_, ignored);  // keeps a folder that is not empty
}

void keep_earlier(const fs::path& file, const Teller& tell) {
    const auto is_there = [](const fs::path& path) {
        return fs::exists(fs::symlink_status(path));  // also a link to nothing
    };
    if (!is_there(file)) return;
    fs::path other;
    for (int number = 1; other.empty() || is_there(other); ++number)
        other = file.parent_path() /
                (file.stem().string() + "." + std::to_string(number) + file.extension().string());
    const std::string name = file.filename().string();
    for (const char* suffix : {"-wal", ""}) {
        if (!is_there(file.string() + suffix)) continue;
        std::error_code error;
        fs::rename(file.string() + suffix, other.string() + suffix, error);
        if (error)
            throw IoError("the existing '" + name + "' cannot be renamed: " + error.message());
    }
    tell("the existing " + name + " was renamed to " + other.filename().string());
}

void keep_earlier_products(const fs::path& folder, const std::string& purpose, const Teller& tell) {
    for (const std::string& name : product_names(purpose)) try {
            check_export_place(folder / name);
        } catch (const IoError&) {
            keep_earlier(folder / name, tell);
        }
}

void name_other_products(const fs::path& folder, const std::string& purpose, const Teller& tell) {
    const std::vector<std::string> own = product_names(purpose);
    std::vector<std::string> others;
    for (const Purpose& other : purposes())
        for (const std::string& name : other.products)
            if (std::ranges::count(own, name) + std::ranges::count(others, name) == 0 &&
                fs::exists(folder / name))
                others.push_back(name);
    if (!others.empty())
        tell("warning: " + enumerated(others) + " in this folder " +
             (others.size() == 1 ? "is" : "are") + " of an earlier preparation, not of this model");
}

}  // namespace vesselbench
