#include "workbench/commands/cohort_commands.h"

#include <algorithm>
#include <memory>

#include "workbench/batch/manifest.h"
#include "workbench/commands/preparing_commands.h"

namespace vesselbench {

namespace {

constexpr const char* kFooter =
    "A manifest is a table in CSV: its first line names the columns, each other line is a case.\n"
    "'input' is required, 'case' names the case and its folder; the options of each case (above)\n"
    "are columns as well, and so is operation.parameter, as in --set. Several values of "
    "neighbour,\n"
    "set, inlet, open and close are separated by ';', accept-doubts is yes or no. Paths are\n"
    "relative to the manifest. An option given here holds for all cases without their own value.\n"
    "OUT gets table.html, table.csv, costs.csv, and a folder cases/NAME for each case. What is\n"
    "finished there is not run again, unless its files, arguments or the program have changed.\n"
    "Where vessel ends are in doubt, OUT gets questions.html, a page that asks about all cases\n"
    "and saves answers.json, which --answers takes. OUT keeps the answers for later batches.\n"
    "Exit code 1 if a case failed, 3 if the manifest or the answers are wrong: then no case was\n"
    "run.\n"
    "\n"
    "  vesselbench batch surfaces --for cfd --out cohort --jobs 2\n"
    "  vesselbench batch cases.csv --for cfd --recipe ours.json --out cohort\n"
    "  vesselbench batch surfaces --for cfd --out cohort --answers answers.json";

/// What the command line declares about an option of `prepare`.
CaseOption case_option(const CLI::Option& option) {
    return {.name = option.get_lnames().front(),
            .is_flag = option.get_items_expected_max() == 0,
            .repeatable = option.get_expected_max() > 1,
            .is_file = option.get_type_name().starts_with("FILE")};
}

/// The options that were added after the first `before`.
std::vector<const CLI::Option*> options_after(CLI::App& command, std::size_t before) {
    std::vector<const CLI::Option*> options;
    for (CLI::Option* option : command.get_options(nullptr))
        if (before > 0)
            --before;
        else
            options.push_back(option->group("Options of each case"));
    return options;
}

CaseColumns columns_of(const std::vector<const CLI::Option*>& options) {
    CaseColumns columns;
    for (const CLI::Option* option : options) {
        const CaseOption declared = case_option(*option);
        columns.options.push_back(declared);
        if (declared.is_flag) {
            if (option->count() > 0 && option->as<bool>())
                columns.shared.push_back({.option = declared.name, .text = {}, .is_flag = true});
            continue;
        }
        for (const std::string& text : option->results())
            columns.shared.push_back({declared.name, text, names_file(declared, text)});
    }
    return columns;
}

void add_limits(CLI::App& command, CaseLimits& limits) {
    command.add_option("--time-limit", limits.time_s, "Of a case [s]; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e9).description(""))
        ->type_name("SECONDS");
    command
        .add_option("--memory-limit", limits.memory_gib,
                    "Of a case, of its processes together [GiB]; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e9).description(""))
        ->type_name("GIB");
}

}  // namespace

void add_cohort_commands(CommandLine& line) {
    const auto options = std::make_shared<BatchArguments>();
    const auto shared = std::make_shared<PrepareArguments>();
    const auto of_cases = std::make_shared<std::vector<const CLI::Option*>>();
    CLI::App& command =
        add_command(line, "batch", "Prepare many cases, and compare them in one table",
                    [options, shared, of_cases, &line] {
                        options->columns = columns_of(*of_cases);
                        return prepare_cases(*options, line.progress) ? 0 : 1;
                    });
    command.footer(kFooter);
    command
        .add_option("CASES", options->cases,
                    "A manifest (.csv), or a folder whose files are the cases")
        ->required()
        ->type_name("");
    add_purpose(command, options->purpose);
    command.add_option("--out", options->out, "Folder of the results; created if missing")
        ->required()
        ->type_name("FOLDER");
    command.add_option("--engine", options->engine, "Where the cases run")
        ->capture_default_str()
        ->check(CLI::IsMember({"local", "slurm"}).description(""))
        ->type_name("local|slurm");
    command
        .add_option("--jobs", options->jobs,
                    "Cases at the same time (default: 1; with Slurm, as many as it allows)")
        ->check(CLI::Range(1, 1024).description(""))
        ->type_name("N");
    command.add_option("--task", options->task, "Run this case, as a task of a job")->group("");
    add_limits(command, options->limits);
    command
        .add_option("--answers", options->answers,
                    "What was answered on OUT/questions.html about vessel ends in doubt")
        ->type_name("FILE.json");
    command.add_flag("--retry", options->retry, "Run the cases again that failed");
    command.add_flag("--dry-run", options->dry_run,
                     "List what would be run, and how long it may take");
    add_json(command, options->json, "Print the table as JSON");
    const std::size_t before = command.get_options(nullptr).size();
    add_case_options(command, *shared);
    *of_cases = options_after(command, before);
}

}  // namespace vesselbench
