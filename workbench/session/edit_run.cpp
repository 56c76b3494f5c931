#include "workbench/session/edit_run.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/case/version.h"
#include "workbench/project/source_files.h"
#include "workbench/project/stored_text.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

/// Diagnostics with the operation that they are about.
std::vector<Diagnostic> about(const std::string& operation, std::vector<Diagnostic> diagnostics) {
    for (Diagnostic& diagnostic : diagnostics)
        if (diagnostic.operation.empty()) diagnostic.operation = operation;
    return diagnostics;
}

void stamp(ResultRecord& record) {
    record.time = utc_now();
    record.program_version = version();
}

}  // namespace

EditRun edit_run(const Operation& operation, Scene input, Outcome outcome, double duration,
                 const Progress& progress) {
    EditRun run;
    ResultRecord& record = run.record;
    record.resolved = without_folders(operation, outcome.resolved);
    record.warnings = about(operation.name, std::move(outcome.warnings));
    if (outcome.report) record.report = stored_text(*outcome.report);
    record.change = surface_change(input, outcome.scene, progress);
    record.duration = duration;
    record.device = outcome.device;
    stamp(record);
    run.input = std::move(input);
    run.scene = std::move(outcome.scene);
    return run;
}

EditRun stale_run(Scene input, const std::string& operation, const std::exception& error) {
    EditRun run;
    run.record.stale_reason = error.what();
    run.record.warnings = about(operation, diagnostics_of(error));
    run.record.device = "cpu";
    stamp(run.record);
    run.input = std::move(input);
    return run;
}

}  // namespace vesselbench
