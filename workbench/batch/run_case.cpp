#include "workbench/batch/run_case.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kLog = "prepare.log";
constexpr int kMostRuns = 3;

/// It stopped in order because it was asked to: the same as killed from outside.
bool was_cancelled(const CaseRun& run) {
    if (run.exit_code != 1) return false;
    try {
        return json_from_text(run.out, "the failure", kLargestStoredJson).value("cancelled", false);
    } catch (const std::exception&) {
        return false;
    }
}

CaseRun prepared(const PlannedCase& one, const BatchOptions& options, const BatchTeller& tell,
                 const Progress& progress) {
    const fs::path folder = options.folders.of(one.what.name);
    for (int runs = 1;; ++runs) {
        const fs::path earlier = begin_case(options.folders, one.what.name);
        if (!earlier.empty())
            tell(one.what.name + " is prepared again: its earlier results are now " +
                 earlier.string());
        std::vector<std::string> arguments = prepare_arguments(one.what, options.purpose, folder);
        arguments.emplace_back("--question");
        CaseRun run = run_program_limited(arguments, folder / kLog, options.limits, progress);
        if (was_cancelled(run)) run.ending = CaseEnding::Killed;
        if (run.ending != CaseEnding::Killed || runs == kMostRuns) return run;
    }
}

/// The table does without it where it cannot be drawn.
void draw_thumbnail(const fs::path& folder, const BatchOptions& options, const Progress& progress) {
    const fs::path surface = folder / "surface.vtp", picture = folder / kThumbnail;
    static_cast<void>(run_program_limited(
        {"picture", surface.string(), picture.string(), "--size", "240", "--json"}, folder / kLog,
        options.limits, progress));
}

CaseRecord prepared_record(const PlannedCase& one, const BatchOptions& options,
                           const BatchTeller& tell, const Progress& progress) {
    const CaseRun run = prepared(one, options, tell, progress);
    CaseRecord record{.key = one.key,
                      .files = one.files,
                      .failure = failure_of(run, options.limits),
                      .limits = options.limits,
                      .seconds = run.seconds,
                      .peak_mib = run.peak_mib,
                      .input_bytes = one.input_bytes};
    if (!record.failure) draw_thumbnail(options.folders.of(one.what.name), options, progress);
    return record;
}

}  // namespace

CaseRecord run_case(const PlannedCase& one, const BatchOptions& options, const BatchTeller& tell,
                    const Progress& progress) {
    try {
        const CaseRecord record = prepared_record(one, options, tell, progress);
        write_record(options.folders.of(one.what.name), record);
        end_case(options.folders, one.what.name);
        return record;
    } catch (const Cancelled&) {
        drop_case(options.folders, one.what.name);
        throw;
    }
}

std::string outcome_text(const CaseRecord& record) {
    const std::string cost =
        " (" + duration_text(record.seconds) + ", " + mebibytes_text(record.peak_mib) + ")";
    if (!record.failure) return "done" + cost;
    const std::string& text = record.failure->text;
    return "failed" + cost + ": " + record.failure->code + ": " + text.substr(0, text.find('\n'));
}

}  // namespace vesselbench
