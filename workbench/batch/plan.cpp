#include "workbench/batch/plan.h"

#include <algorithm>

#include "geometry/kernel/bare_name.h"
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

/// Limits count for what failed by them alone.
bool is_current(const CaseRecord& record, const std::string& key, const CaseLimits& limits) {
    if (record.key != key) return false;
    if (!record.failure || record.limits == limits) return true;
    return record.failure->code != "time-limit" && record.failure->code != "memory-limit";
}

}  // namespace

PlannedCase planned(const BatchCase& one, const BatchOptions& options, const std::string& program) {
    std::optional<CaseRecord> record = read_record(options.folders.of(one.name));
    FileDigests digests(record ? record->files : Json());
    const fs::path input = file_of_input(one.input);
    Json values = Json::array();
    for (const CaseValue& value : one.values)
        if (value.is_file)
            values.push_back({value.option, bare_name(value.text), digests.next(value.text)});
        else
            values.push_back({value.option, value.text});
    const Json all = {{"program", program},
                      {"purpose", options.purpose},
                      {"name", bare_name(one.input)},
                      {"input", digests.next(input)},
                      {"values", values}};
    PlannedCase plan{.what = one,
                     .key = hash_of_text(text_from_json(all)),
                     .files = digests.json(),
                     .input_bytes = bytes_of(input),
                     .record = {}};
    if (record && is_current(*record, plan.key, options.limits)) plan.record = std::move(record);
    if (options.retry && plan.record && plan.record->failure &&
        !is_finished_by_hand(plan, options.folders))
        plan.record.reset();
    return plan;
}

std::vector<PlannedCase> planned(const std::vector<BatchCase>& cases, const BatchOptions& options) {
    const std::string program = hash_of_file("/proc/self/exe");
    std::vector<PlannedCase> plans;
    for (const BatchCase& one : cases) plans.push_back(planned(one, options, program));
    return plans;
}

bool is_finished_by_hand(const PlannedCase& one, const BatchFolders& folders) {
    return one.record && one.record->failure && !read_report(folders.of(one.what.name)).is_null();
}

}  // namespace vesselbench
