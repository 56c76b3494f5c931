#include "workbench/batch/batch.h"

#include <filesystem>
#include <memory>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/batch/answered_plan.h"
#include "workbench/batch/batch_cost.h"
#include "workbench/batch/questions.h"
#include "workbench/batch/questions_page.h"
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
    const std::vector<CaseQuestion> questions = open_questions(cases, options.folders);
    BatchTable table = batch_table(cases, options);
    table.questions = questions.size();
    PendingFiles files;
    const fs::path& out = options.folders.out;
    files.add_text(out / "table.csv", table_csv(table));
    files.add_text(out / "table.html", table_page(table));
    files.add_text(out / "costs.csv", costs_csv(cases));
    if (!questions.empty()) files.add_text(out / kQuestionsPage, questions_page(questions));
    files.commit();
    std::error_code ignored;
    if (questions.empty()) fs::remove(out / kQuestionsPage, ignored);
    return table;
}

/// The plan, whose answers are kept before any case runs: the tasks of a cluster read them there.
std::vector<PlannedCase> kept_plan(const std::vector<BatchCase>& cases, const BatchOptions& options,
                                   const BatchTeller& tell) {
    AnsweredPlan plan = plan_with_answers(cases, options, tell);
    if (!options.answers.empty() && !plan.answers.empty())
        write_file(options.folders.out / kAnswers, text_of(plan.answers));
    return std::move(plan.cases);
}

}  // namespace

BatchResult run_batch(const std::vector<BatchCase>& cases, const BatchOptions& options,
                      const BatchEngine& engine, const BatchTeller& tell) {
    make_folder(options.folders.out);
    const std::unique_ptr<FileLock> lock = locked(options.folders.out);
    std::vector<PlannedCase> plans = kept_plan(cases, options, tell);
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
