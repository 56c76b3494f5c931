#include "workbench/batch/slurm.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <thread>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/batch/answered_plan.h"
#include "workbench/case/shell_text.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/file_lock.h"
#include "workbench/worker/child_process.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTasks = 1000;  // of one job; Slurm's own default is 1001
constexpr int kMostSubmissions = 3;       // of one case
constexpr auto kPoll = std::chrono::seconds(2);
constexpr auto kAnswer = std::chrono::seconds(120);  // of Slurm's programs
constexpr int kMostSilent = 60;  // questions without an answer, one after another

class SlurmBatch {
public:
    SlurmBatch(std::vector<PlannedCase>& cases, const BatchOptions& options,
               std::vector<std::string> task, const BatchTeller& tell, const Progress& progress)
        : options_(options),
          task_(std::move(task)),
          tell_(tell),
          progress_(progress.silent()),
          folder_(options.folders.out / "slurm"),
          job_("vesselbench-" +
               hash_of_text(fs::weakly_canonical(options.folders.out).string()).substr(0, 12)) {
        for (PlannedCase& one : cases)
            if (!one.record) left_.push_back(&one);
        all_ = left_.size();
    }

    void run() {
        make_folder(folder_);
        try {
            wait_for_jobs();         // of an earlier batch
            options_.retry = false;  // what fails from here on has been tried
            for (PlannedCase* one : left_)
                static_cast<void>(begin_case(options_.folders, one->what.name));
            while (!left_.empty()) {
                submit();
                wait_for_jobs();
            }
        } catch (const Cancelled&) {
            static_cast<void>(run_to_end({"scancel", "--name=" + job_}, "", kAnswer));
            throw;
        }
    }

private:
    /// Until none of this folder is in the queue.
    void wait_for_jobs() {
        for (bool queued = true; queued;) {
            queued = is_queued();
            collect();
            if (!queued || left_.empty()) break;
            for (auto waited = kPoll * 0; waited < kPoll; waited += std::chrono::seconds(1)) {
                progress_.check_cancelled();
                std::this_thread::sleep_for(std::chrono::seconds(1));
            }
        }
    }

    /// A controller that does not answer may come back.
    [[nodiscard]] bool is_queued() {
        std::string why;
        try {
            const ProgramResult queue = run_to_end(
                {"squeue", "--noheader", "--me", "--name=" + job_, "--format=%A"}, "", kAnswer);
            if (queue.exit_code == 0) {
                silent_ = 0;
                return !queue.out.empty();
            }
            why = printable(queue.err);
        } catch (const AlgorithmFailure& failure) {  // no answer in time
            why = failure.what();
        }
        if (++silent_ == 1) tell_("squeue does not answer; waiting: " + why);
        if (silent_ == kMostSilent)
            throw IoError("squeue does not answer: " + why +
                          "; the jobs go on: run the batch again");
        return true;
    }

    void collect() {
        std::vector<PlannedCase*> left;
        for (PlannedCase* one : left_) {
            std::optional<CaseRecord> record = read_record(options_.folders.of(one->what.name));
            if (record && is_current(*record, *one, options_))
                finish(*one, std::move(*record));
            else
                left.push_back(one);
        }
        left_ = std::move(left);
    }

    void finish(PlannedCase& one, CaseRecord record) {
        one.record = std::move(record);
        tell_(std::to_string(++done_) + "/" + std::to_string(all_) + " " + one.what.name + ": " +
              outcome_text(*one.record));
    }

    /// What has died each time has a record, too.
    void give_up(PlannedCase& one) {
        CaseRun run;
        run.ending = CaseEnding::Killed;
        CaseRecord record{.key = one.key,
                          .files = one.files,
                          .failure = failure_of(run, options_.limits),
                          .limits = options_.limits,
                          .seconds = 0.0,
                          .peak_mib = 0.0,
                          .input_bytes = one.input_bytes};
        static_cast<void>(begin_case(options_.folders, one.what.name));
        write_record(options_.folders.of(one.what.name), record);
        end_case(options_.folders, one.what.name);
    }

    void submit() {
        std::string names;
        std::size_t count = 0;
        for (PlannedCase* one : left_) {
            if (submissions_[one->what.name] == kMostSubmissions) {
                give_up(*one);
            } else if (count < kMostTasks) {
                ++submissions_[one->what.name];
                names += one->what.name + "\n";
                ++count;
            }
        }
        if (count == 0) return;
        write_file(folder_ / "cases.txt", names);
        write_file(folder_ / "job.sh", script());
        const ProgramResult made = run_to_end(sbatch(count), "", kAnswer, progress_);
        if (made.exit_code != 0) throw IoError("sbatch refuses the job: " + printable(made.err));
        tell_("submitted " + counted(count, "case") + " as job " +
              printable(made.out.substr(0, made.out.find_first_of(";\n"))));
    }

    [[nodiscard]] std::string script() const {
        std::vector<std::string> words;
        for (const std::string& word : task_) words.push_back(shell_quoted(word));
        return "#!/bin/sh\nname=$(sed -n \"${SLURM_ARRAY_TASK_ID}p\" " +
               shell_quoted(fs::absolute(folder_ / "cases.txt").string()) +
               ")\n[ -n \"$name\" ] && exec " + joined(words, " ") + "=\"$name\"\n";
    }

    [[nodiscard]] std::vector<std::string> sbatch(std::size_t count) const {
        const std::string at_once = options_.jobs > 0 ? "%" + std::to_string(options_.jobs) : "";
        std::vector<std::string> command = {
            "sbatch", "--parsable", "--job-name=" + job_,
            "--array=1-" + std::to_string(count) + at_once,
            "--output=" + fs::absolute(folder_ / "%A-%a.log").string()};
        if (options_.limits.time_s > 0.0)  // a minute more: the case's own limit comes first
            command.push_back(
                formatted(std::ceil(options_.limits.time_s / 60.0) + 1.0, "--time=%.0f"));
        if (options_.limits.memory_gib > 0.0)
            command.push_back(
                formatted(std::ceil(1024.0 * options_.limits.memory_gib) + 256.0, "--mem=%.0fM"));
        command.push_back(fs::absolute(folder_ / "job.sh").string());
        return command;
    }

    BatchOptions options_;
    const std::vector<std::string> task_;
    const BatchTeller& tell_;
    const Progress progress_;
    const fs::path folder_;
    const std::string job_;  // its name, by which the queue knows it
    std::vector<PlannedCase*> left_;
    std::map<std::string, int> submissions_;
    std::size_t all_ = 0, done_ = 0;
    int silent_ = 0;  // questions to the queue without an answer, the last ones
};

}  // namespace

void run_on_slurm(std::vector<PlannedCase>& cases, const BatchOptions& options,
                  const std::vector<std::string>& task, const BatchTeller& tell,
                  const Progress& progress) {
    SlurmBatch(cases, options, task, tell, progress).run();
}

void run_task(const BatchCase& one, const BatchOptions& options, const BatchTeller& tell,
              const Progress& progress) {
    const FileLock::Attempt attempt = FileLock::acquire(options.folders.out / "slurm" / one.name);
    if (attempt.lock == nullptr) throw IoError("'" + one.name + "': " + attempt.reason);
    const auto quiet = [](const std::string&) {};  // the batch itself has said it
    const PlannedCase plan = plan_with_answers({one}, options, quiet).cases.front();
    if (!plan.record) static_cast<void>(run_case(plan, options, tell, progress));
}

}  // namespace vesselbench
