#include "workbench/batch/batch.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/batch/answered_plan.h"
#include "workbench/batch/batch_cost.h"
#include "workbench/batch/questions_page.h"
#include "workbench/batch/run_cases.h"
#include "workbench/batch/slurm.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/commands/cohort_commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

std::vector<BatchCase> cases_of(const BatchArguments& arguments) {
    if (!fs::is_directory(arguments.cases))
        return cases_of_manifest(arguments.cases, arguments.columns);
    std::vector<std::string> skipped;
    std::vector<BatchCase> cases =
        cases_in_folder(arguments.cases, arguments.columns,
                        [&](const std::string& name) { skipped.push_back(name); });
    if (!skipped.empty()) remark("left out, as prepare does not read them: " + joined(skipped));
    return cases;
}

/// What runs one of the cases: the name of one follows.
std::vector<std::string> task_command(const BatchArguments& arguments) {
    std::vector<std::string> words = {
        fs::read_symlink("/proc/self/exe").string(),
        "batch",
        arguments.cases,
        "--for",
        arguments.purpose,
        "--out",
        arguments.out,
        formatted(arguments.limits.time_s, "--time-limit=%.17g"),
        formatted(arguments.limits.memory_gib, "--memory-limit=%.17g")};
    for (const CaseValue& value : arguments.columns.shared) words.push_back(value.argument());
    words.emplace_back("--task");
    return words;
}

BatchEngine engine_of(const BatchArguments& arguments, const BatchOptions& options,
                      const Progress& progress) {
    if (arguments.engine == "slurm")
        return [&](std::vector<PlannedCase>& cases) {
            run_on_slurm(cases, options, task_command(arguments), &remark, progress);
        };
    return [&](std::vector<PlannedCase>& cases) { run_cases(cases, options, &remark, progress); };
}

/// \throw UsageError if there is no case of this name
const BatchCase& case_named(const std::vector<BatchCase>& cases, const std::string& name) {
    const auto found = std::ranges::find(cases, name, &BatchCase::name);
    if (found == cases.end()) throw UsageError("there is no case '" + printable(name) + "'");
    return *found;
}

BatchOptions options_of(const BatchArguments& arguments) {
    return {.folders = {arguments.out},
            .purpose = find_purpose(arguments.purpose).name,
            .limits = arguments.limits,
            .jobs = arguments.jobs == 0 && arguments.engine == "local" ? 1 : arguments.jobs,
            .retry = arguments.retry,
            .answers = arguments.answers};
}

std::string plan_word(const PlannedCase& one) {
    if (!one.record) return "to be run";
    return one.record->failure ? "failed: " + one.record->failure->code : "finished";
}

void print_plan(const std::vector<PlannedCase>& cases, std::size_t jobs) {
    std::vector<std::vector<std::string>> rows = {{"case", "state", "MiB", "input"}};
    for (const PlannedCase& one : cases)
        rows.push_back({one.what.name, plan_word(one),
                        formatted(static_cast<double>(one.input_bytes) / (1U << 20U), "%.1f"),
                        one.what.input});
    std::cout << as_columns(rows);
    for (const std::string& text : {cost_text(cases, jobs), estimate_text(cases, jobs)})
        if (!text.empty()) std::cout << text << "\n";
}

void print_failure(const FailureGroup& group) {
    std::vector<std::vector<std::string>> rows = {
        {"cases", joined(group.cases)}, {"first", group.text.substr(0, group.text.find('\n'))}};
    for (const std::string& remedy : group.remedies) rows.push_back({"try", remedy});
    std::cout << "\n"
              << group.code << ", " << counted(group.cases.size(), "case") << ":\n"
              << as_columns(rows);
}

void print_result(const BatchResult& result, const BatchArguments& arguments) {
    const BatchTable& table = result.table;
    std::cout << counted(table.rows.size(), "case") << ", "
              << table.rows.size() - table.count(CaseState::Failed) << " with a model, "
              << table.count(CaseState::Failed) << " failed\n";
    for (const FailureGroup& group : table.failures) print_failure(group);
    const fs::path out = arguments.out;
    std::cout << "\ntable:  " << (out / "table.html").string() << ", "
              << (out / "table.csv").string() << "\n";
    if (table.questions > 0)
        std::cout << "ask:    " << (out / kQuestionsPage).string() << " ("
                  << counted(table.questions, "case") << "): answer there, and add --answers\n";
    const std::string cost = cost_text(result.cases, options_of(arguments).jobs);
    if (!cost.empty()) std::cout << "cost:   " << cost << "\n";
}

}  // namespace

bool prepare_cases(const BatchArguments& arguments, const Progress& progress) {
    const std::vector<BatchCase> cases = cases_of(arguments);
    const BatchOptions options = options_of(arguments);
    if (!arguments.task.empty()) {
        run_task(case_named(cases, arguments.task), options, &remark, progress);
        return true;
    }
    if (arguments.dry_run) {
        const std::vector<PlannedCase> plans = plan_with_answers(cases, options, &remark).cases;
        if (arguments.json)
            std::cout << text_from_json(table_json(batch_table(plans, options)), 2) << "\n";
        else
            print_plan(plans, options.jobs);
        return true;
    }
    const BatchResult result =
        run_batch(cases, options, engine_of(arguments, options, progress), &remark);
    if (arguments.json)
        std::cout << text_from_json(table_json(result.table), 2) << "\n";
    else
        print_result(result, arguments);
    return result.table.count(CaseState::Failed) == 0;
}

}  // namespace vesselbench
