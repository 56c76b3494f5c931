#include "workbench/prepare/result_folder.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/export/products.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The last one lists the results.
constexpr std::array kReports = {"report.html", "report.json"};

/// True for the report of a preparation, also of one that stopped.
bool is_own_report(const Json& report) {
    if (!report.is_object() || !report.contains("program_version")) return false;
    return report.contains("products") || report.contains("stopped");
}

bool lists(const Json& report, const char* key, const std::string& name) {
    const auto list = report.find(key);
    return list != report.end() && list->is_array() && std::ranges::count(*list, Json(name)) > 0;
}

bool may_replace(const fs::path& place) {
    try {
        check_export_place(place);
        return true;
    } catch (const IoError&) {
        return false;
    }
}

}  // namespace

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

std::vector<std::string> result_names(const std::string& purpose) {
    std::vector<std::string> names = product_names(purpose);
    names.insert(names.end(), kReports.begin(), kReports.end());
    return names;
}

std::vector<std::string> earlier_results(const fs::path& folder) {
    Json report;
    try {
        report = json_from_text(file_content(folder / kReports.back()), kReports.back(),
                                kLargestStoredJson);
    } catch (const std::exception&) {
        return {};
    }
    if (!is_own_report(report)) return {};
    std::vector<std::string> names;
    for (const std::string name : kReports)  // one that stopped wrote the last one only
        if (name == kReports.back() || report.contains("products") ||
            lists(report, "earlier_results", name))
            names.push_back(name);
    for (const Purpose& purpose : purposes())
        for (std::string& name : product_names(purpose.name))
            if (std::ranges::count(names, name) == 0 &&
                (lists(report, "products", name) || lists(report, "earlier_results", name)))
                names.push_back(std::move(name));
    return names;
}

void keep_irreplaceable(const fs::path& folder, const std::vector<std::string>& names,
                        const Teller& tell) {
    for (const std::string& name : names)
        if (!may_replace(folder / name)) keep_earlier(folder / name, tell);
}

void keep_others(const fs::path& folder, const std::vector<std::string>& names,
                 const std::vector<std::string>& earlier, const Teller& tell) {
    for (const std::string& name : names)
        if (std::ranges::count(earlier, name) == 0) keep_earlier(folder / name, tell);
}

std::vector<std::string> remaining_results(const fs::path& folder,
                                           const std::vector<std::string>& names,
                                           const std::vector<std::string>& earlier) {
    std::vector<std::string> remaining;
    for (const std::string& name : earlier)
        if (std::ranges::count(names, name) == 0 && fs::exists(folder / name))
            remaining.push_back(name);
    return remaining;
}

}  // namespace vesselbench
