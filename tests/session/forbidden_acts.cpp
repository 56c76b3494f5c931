#include "tests/session/forbidden_acts.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"

namespace vesselbench::test {

namespace {

/// The error's number of a call, 0 if it returned no error.
int error_of(long result) {
    return result < 0 ? errno : 0;
}

int fork_error() {
    const pid_t process = fork();
    if (process == 0) _exit(0);
    return error_of(process);
}

int exec_error() {
    char name[] = "/bin/true";
    char* const words[] = {name, nullptr};
    return error_of(execv(name, words));
}

int calculation_error() {
    std::atomic<int> sum = 0;
    tbb::parallel_for(0, 10000, [&](int) { ++sum; });
    return sum == 10000 ? 0 : ECANCELED;
}

int act_at(const std::string& what, const char* path) {
    if (what == "read") return error_of(open(path, O_RDONLY | O_CLOEXEC));
    if (what == "list") return error_of(open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (what == "write") return error_of(open(path, O_WRONLY | O_CLOEXEC));
    if (what == "make") return error_of(open(path, O_WRONLY | O_CREAT | O_CLOEXEC, S_IRUSR));
    if (what == "remove") return error_of(unlink(path));
    if (what == "chmod") return error_of(chmod(path, S_IRUSR | S_IROTH));
    throw UsageError("what='" + what + "'");
}

int act(const std::string& what, const std::string& at) {
    if (what == "socket") return error_of(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (what == "exec") return exec_error();
    if (what == "fork") return fork_error();
    if (what == "signal") return error_of(kill(getppid(), 0));
    if (what == "calculate") return calculation_error();
    if (what != "read in a thread") return act_at(what, at.c_str());
    int error = 0;
    std::thread([&] { error = act_at("read", at.c_str()); }).join();
    return error;
}

}  // namespace

Outcome forbidden_act(const Scene& scene, const Arguments& arguments, Progress&) {
    Outcome outcome{.scene = scene, .resolved = arguments};
    const int error = act(arguments.text("what"), arguments.optional_text("at").value_or(""));
    outcome.warnings.push_back(plain_text(std::to_string(error)));
    return outcome;
}

}  // namespace vesselbench::test
