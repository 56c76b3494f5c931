#include "workbench/batch/case_process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "workbench/worker/child_process.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kCaseProcess = "--case-of";
constexpr auto kPoll = std::chrono::milliseconds(25);
constexpr double kMebibyte = 1024.0 * 1024.0;

/// Of one process [MiB]; 0: it has ended.
double resident_mib(const std::string& process) {
    std::ifstream file("/proc/" + process + "/statm");
    double size = 0.0, resident = 0.0;
    file >> size >> resident;
    return file ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMebibyte : 0.0;
}

/// Of a process and all that it started [MiB].
double family_mib(const std::string& process) {
    double sum = resident_mib(process);
    std::error_code error;
    for (fs::directory_iterator thread("/proc/" + process + "/task", error), end;
         !error && thread != end; thread.increment(error)) {
        std::ifstream children(thread->path() / "children");
        for (std::string child; children >> child;) sum += family_mib(child);
    }
    return sum;
}

Descriptor opened_log(const fs::path& log) {
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0) throw IoError("'" + log.filename().string() + "' cannot be written");
    return moved_up(file);
}

std::string whole_content(const Descriptor& file) {
    constexpr std::size_t kLargest = std::size_t{64} << 20;

    struct stat info {};

    if (fstat(file.number(), &info) != 0) return {};
    std::string text(std::min(kLargest, static_cast<std::size_t>(info.st_size)), '\0');
    const auto got = pread(file.number(), text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<decltype(got)>(got, 0)));
    return text;
}

/// A crash of its own is no reason to try again; a signal from outside is.
void set_status(CaseRun& run, int status) {
    run.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP)
        run.ending = CaseEnding::Killed;
}

}  // namespace

CaseRun run_program_limited(const std::vector<std::string>& arguments, const fs::path& log,
                            const CaseLimits& limits, const Progress& progress) {
    std::vector<std::string> command = {"/proc/self/exe", kCaseProcess, std::to_string(getpid())};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Descriptor out = memory_file("vesselbench-case"), errors = opened_log(log);
    const auto start = Clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    Child child({.command = command,
                 .ends = {{out.number(), STDOUT_FILENO}, {errors.number(), STDERR_FILENO}},
                 .environment = {},
                 .own_group = true});
    const std::string process = std::to_string(child.number());
    CaseRun run;
    while (run.ending == CaseEnding::Ended) {
        if (const std::optional<int> status = child.ended()) {
            set_status(run, *status);
            break;
        }
        progress.check_cancelled();
        run.peak_mib = std::max(run.peak_mib, family_mib(process));
        if (limits.time_s > 0.0 && seconds() > limits.time_s) run.ending = CaseEnding::TimeLimit;
        if (limits.memory_gib > 0.0 && run.peak_mib > 1024.0 * limits.memory_gib)
            run.ending = CaseEnding::MemoryLimit;
        std::this_thread::sleep_for(kPoll);
    }
    run.seconds = seconds();
    run.out = whole_content(out);
    return run;
}

void enter_case_process(int& argc, char**& argv) {
    if (argc < 4 || std::string_view(argv[1]) != kCaseProcess) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(getppid()) != argv[2]) std::_Exit(EXIT_FAILURE);  // it has ended already
    argv[2] = argv[0];
    argc -= 2;
    argv += 2;
}

}  // namespace vesselbench
