#include "workbench/batch/case_record.h"

#include <cstdint>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRecord = "batch.json";

CaseRecord record_from(const Json& json) {
    JsonFields fields(json, kRecord);
    CaseRecord record{.key = fields.required<std::string>("key"),
                      .files = {},
                      .failure = {},
                      .limits = {.time_s = fields.required<double>("time_limit_s"),
                                 .memory_gib = fields.required<double>("memory_limit_gib")},
                      .seconds = fields.required<double>("seconds"),
                      .peak_mib = fields.required<double>("peak_mib"),
                      .input_bytes = fields.required<std::uint64_t>("input_bytes")};
    if (const Json* files = fields.child("files")) record.files = *files;
    const Json* failure = fields.child("failure");
    if (failure == nullptr || failure->is_null()) return record;
    JsonFields why(*failure, fields.place_of("failure"));
    record.failure = {.code = why.required<std::string>("code"),
                      .text = why.required<std::string>("text"),
                      .remedies = why.required<std::vector<std::string>>("remedies")};
    return record;
}

Json failure_json(const std::optional<CaseFailure>& failure) {
    if (!failure) return {};
    return {{"code", failure->code}, {"text", failure->text}, {"remedies", failure->remedies}};
}

/// What a remedy is in a manifest: a column and its value.
std::string remedy_text(const Diagnostic& diagnostic, const Remedy& remedy) {
    const std::string operation =
        remedy.operation.empty() ? diagnostic.operation : remedy.operation;
    if (remedy.action == RemedyAction::Remove) return "without " + operation;
    if (remedy.action == RemedyAction::ChooseAgain) return operation + " decides again";
    std::vector<std::string> texts;
    for (const auto& [name, value] : remedy.arguments)
        texts.push_back((remedy.before || operation.empty() ? "" : operation + ".") + name + "=" +
                        (value.empty() ? "..." : value));
    return remedy.before ? operation + " " + joined(texts, " ") + " before" : joined(texts);
}

CaseFailure failure_from(const Diagnostic& diagnostic) {
    CaseFailure failure{
        .code = diagnostic.code, .text = worded_with_operation(diagnostic), .remedies = {}};
    for (const Remedy& remedy : diagnostic.remedies)
        failure.remedies.push_back(remedy_text(diagnostic, remedy));
    return failure;
}

std::string code_of(int exit_code) {
    return exit_code == 3 ? "bad-input" : exit_code == 2 ? "wrong-usage" : "failed";
}

/// \param json what the program printed when it failed
CaseFailure reported_failure(const Json& json, int exit_code) {
    JsonFields fields(json, "the failure");
    const std::string text = fields.required<std::string>("error");
    if (const Json* found = fields.child("diagnostics"); found != nullptr && !found->empty())
        return failure_from(diagnostics_from(*found, "diagnostics").front());
    return {.code = code_of(exit_code), .text = text, .remedies = {}};
}

}  // namespace

std::optional<CaseRecord> read_record(const fs::path& folder) {
    try {
        return record_from(
            json_from_text(file_content(folder / kRecord), kRecord, kLargestStoredJson));
    } catch (const IoError&) {
        return std::nullopt;
    } catch (const InvalidInput&) {
        return std::nullopt;
    }
}

bool has_record(const fs::path& folder) {
    std::error_code error;
    return fs::exists(folder / kRecord, error);
}

void write_record(const fs::path& folder, const CaseRecord& record) {
    const Json json = {{"key", record.key},
                       {"failure", failure_json(record.failure)},
                       {"time_limit_s", record.limits.time_s},
                       {"memory_limit_gib", record.limits.memory_gib},
                       {"seconds", record.seconds},
                       {"peak_mib", record.peak_mib},
                       {"input_bytes", record.input_bytes},
                       {"files", record.files}};
    write_file(folder / kRecord, text_from_json(json, 2) + "\n");
}

std::optional<CaseFailure> failure_of(const CaseRun& run, const CaseLimits& limits) {
    if (run.ending == CaseEnding::TimeLimit)
        return CaseFailure{"time-limit",
                           formatted(limits.time_s, "it took longer than %g s"),
                           {"--time-limit=..."}};
    if (run.ending == CaseEnding::MemoryLimit)
        return CaseFailure{"memory-limit",
                           formatted(limits.memory_gib, "it took more memory than %g GiB"),
                           {"--memory-limit=..."}};
    if (run.ending == CaseEnding::Ended && run.exit_code == 0) return std::nullopt;
    if (run.ending == CaseEnding::Killed)
        return CaseFailure{
            "killed", "another program ended it, each time it was tried", {"--retry"}};
    if (run.exit_code > 128)
        return CaseFailure{
            "crashed", "the program ended by signal " + std::to_string(run.exit_code - 128), {}};
    try {
        return reported_failure(json_from_text(run.out, "the failure", kLargestStoredJson),
                                run.exit_code);
    } catch (const InvalidInput&) {
        return CaseFailure{code_of(run.exit_code),
                           "the program ended with exit code " + std::to_string(run.exit_code),
                           {}};
    }
}

}  // namespace vesselbench
