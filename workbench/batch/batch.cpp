#include "workbench/batch/batch.h"

#include <filesystem>
#include <memory>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/batch/batch_cost.h"
#include "workbench/batch/table_page.h"
#include "workbench/project/file_lock.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// \throw IoError if another batch has it
std::unique_ptr<FileLock> locked(const fs::path& out) {
    FileLock::Attempt attempt = FileLock::acquire(out / "batch");
    if (attempt.lock == nullptr)
        throw IoError("no batch can run in '" + bare_name(out) + "': " + attempt.reason);
    return std::move(attempt.lock);
}

BatchTable written_table(const std::vector<PlannedCase>& cases, const BatchOptions& options) {
    BatchTable table = batch_table(cases, options);
    PendingFiles files;
    const fs::path& out = options.folders.out;
    files.add_text(out / "table.csv", table_csv(table));
    files.add_text(out / "table.html", table_page(table));
    files.add_text(out / "costs.csv", costs_csv(cases));
    files.commit();
    return table;
}

}  // namespace

BatchResult run_batch(const std::vector<BatchCase>& cases, const BatchOptions& options,
                      const BatchEngine& engine) {
    make_folder(options.folders.out);
    const std::unique_ptr<FileLock> lock = locked(options.folders.out);
    std::vector<PlannedCase> plans = planned(cases, options);
    try {
        engine(plans);
    } catch (...) {
        try {
            static_cast<void>(written_table(plans, options));
        } catch (const IoError&) {  // what stopped the batch says more
        }
        throw;
    }
    BatchTable table = written_table(plans, options);
    return {std::move(plans), std::move(table)};
}

}  // namespace vesselbench
