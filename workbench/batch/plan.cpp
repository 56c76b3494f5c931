#include "workbench/batch/plan.h"

#include <algorithm>
#include <fstream>
#include <map>

#include "geometry/formats/format.h"
#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/label_table_places.h"
#include "geometry/kernel/wording.h"
#include "workbench/batch/case_report.h"
#include "workbench/batch/file_digests.h"
#include "workbench/case/json_text.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/project/content_hash.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path file_of_input(const std::string& input) {
    std::error_code ignored;
    const fs::path bundled = fs::exists(input, ignored) ? fs::path() : bundled_case(input);
    return bundled.empty() ? fs::path(input) : bundled;
}

/// The file with the voxels that the header of an image names; empty: it has them itself.
fs::path detached_voxels(const fs::path& image) {
    const std::string suffix = lower_suffix(image.string());
    if (suffix != ".mhd" && suffix != ".nhdr" && suffix != ".nrrd" && suffix != ".mha") return {};
    constexpr int kMostLines = 200;
    std::ifstream header(image);
    std::string line;
    for (int i = 0; i < kMostLines && std::getline(header, line) && !line.empty(); ++i) {
        const std::size_t at = line.find_first_of("=:");
        std::string key = lower_case(line.substr(0, at));
        std::erase(key, ' ');
        if (at == std::string::npos || (key != "elementdatafile" && key != "datafile")) continue;
        std::string name = line.substr(at + 1);
        name.erase(0, name.find_first_not_of(" \t"));
        name.erase(name.find_last_not_of(" \t\r") + 1);
        return lower_case(name) == "local" ? fs::path() : image.parent_path() / name;
    }
    return {};
}

std::size_t bytes_of(const fs::path& path) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        const auto size = fs::file_size(path, error);
        return error ? 0 : size;
    }
    std::size_t sum = 0;
    for (const auto& entry : fs::directory_iterator(path, error))
        if (entry.is_regular_file(error)) sum += bytes_of(entry.path());
    return sum;
}

/// Of a file, of the voxels that it names, and of the table that names its labels.
std::string digest_with_voxels(const fs::path& file, FileDigests& digests) {
    std::string all = digests.next(file);
    if (const fs::path voxels = detached_voxels(file); !voxels.empty())
        all += " " + digests.next(voxels);
    std::error_code ignored;
    for (const fs::path& table : label_table_places(file))
        if (fs::is_regular_file(table, ignored)) all += " " + digests.next(table);
    return all;
}

/// Digests of the files among a case's values.
struct ValueFiles {
    std::map<std::string, std::string> digests;  ///< by the value's text
    std::string mask;                            ///< of the mask, a blank before it; may be empty
};

ValueFiles digested_files(const std::vector<CaseValue>& values, FileDigests& digests) {
    ValueFiles files;
    for (const CaseValue& value : values) {
        if (!value.is_file) continue;
        const std::string digest = digest_with_voxels(value.text, digests);
        files.digests[value.text] = digest;
        if (value.option == "mask") files.mask = " " + digest;
    }
    return files;
}

bool is_by_limit(const CaseFailure& failure) {
    return failure.code == "time-limit" || failure.code == "memory-limit";
}

}  // namespace

bool is_current(const CaseRecord& record, const PlannedCase& one, const BatchOptions& options) {
    if (record.key != one.key) return false;
    const bool has_report = !read_report(options.folders.of(one.what.name)).is_null();
    if (options.retry && !has_report) return false;
    if (!record.failure || (options.retry && has_report)) return true;
    return record.limits == options.limits || !is_by_limit(*record.failure);
}

PlannedCase planned(const BatchCase& one, const BatchOptions& options, const std::string& program,
                    const Answers& answers) {
    std::optional<CaseRecord> record = read_record(options.folders.of(one.name));
    FileDigests digests(record ? record->files : Json());
    const fs::path input = file_of_input(one.input);
    const ValueFiles files = digested_files(one.values, digests);
    const std::string of_input = digest_with_voxels(input, digests);
    PlannedCase plan{.what = one,
                     .key = {},
                     .files = digests.json(),
                     .sha256 = of_input + files.mask,
                     .input_bytes = bytes_of(input) + bytes_of(detached_voxels(input)),
                     .record = {}};
    if (const auto found = answers.find(one.name); found != answers.end()) {
        plan.outdated = found->second.sha256 != plan.sha256;
        if (!plan.outdated) plan.what = answered(one, found->second);
    }
    Json values = Json::array();
    for (const CaseValue& value : plan.what.values)
        if (value.is_file)
            values.push_back({value.option, bare_name(value.text), files.digests.at(value.text)});
        else
            values.push_back({value.option, value.text});
    const Json all = {{"program", program},
                      {"purpose", options.purpose},
                      {"name", bare_name(one.input)},
                      {"input", of_input},
                      {"values", values}};
    plan.key = hash_of_text(text_from_json(all));
    if (record && is_current(*record, plan, options)) plan.record = std::move(record);
    return plan;
}

std::vector<PlannedCase> planned(const std::vector<BatchCase>& cases, const BatchOptions& options,
                                 const Answers& answers) {
    const std::string program = hash_of_file("/proc/self/exe");
    std::vector<PlannedCase> plans;
    for (const BatchCase& one : cases) plans.push_back(planned(one, options, program, answers));
    return plans;
}

bool is_finished_by_hand(const PlannedCase& one, const BatchFolders& folders) {
    return one.record && one.record->failure && !read_report(folders.of(one.what.name)).is_null();
}

}  // namespace vesselbench
