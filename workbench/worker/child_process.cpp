#include "workbench/worker/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr int kFirstFree = 10;

/// As exec wants them, without the null at the end.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    return pointers;
}

std::string content_of(const Descriptor& file) {
    constexpr std::size_t kLargest = std::size_t{64} << 10;
    std::string text(kLargest, '\0');
    const auto got = pread(file.number(), text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<decltype(got)>(got, 0)));
    return text;
}

int exit_code_of(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

Descriptor::Descriptor(int number) : number_(number) {
    if (number < 0) throw IoError("cannot start another process: too many open files");
}

void Descriptor::reset() {
    if (number_ >= 0) close(number_);
    number_ = -1;
}

Descriptor moved_up(int number) {
    const Descriptor low(number);
    return Descriptor(fcntl(number, F_DUPFD_CLOEXEC, kFirstFree));
}

Descriptor memory_file(const char* name) {
    return moved_up(memfd_create(name, MFD_CLOEXEC));
}

void write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto done = write(descriptor, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0 && errno == EFBIG)
            throw IoError(
                "cannot pass data to another process: it is larger than the limit on the "
                "size of files; raise it (ulimit -f)");
        if (done <= 0) throw IoError("cannot pass data to another process: out of memory");
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

Child::Child(const ChildSetup& setup) : own_group_(setup.own_group) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    std::array<bool, kFirstFree> given{};
    int last = STDERR_FILENO;
    for (const auto& [own, number] : setup.ends) {
        posix_spawn_file_actions_adddup2(&actions, own, number);
        given.at(static_cast<std::size_t>(number)) = true;
        last = std::max(last, number);
    }
    for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (!given.at(static_cast<std::size_t>(number)))
            posix_spawn_file_actions_addopen(&actions, number, "/dev/null",
                                             number == STDIN_FILENO ? O_RDONLY : O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, last + 1);  // no socket of ours
    std::vector<std::string> command = setup.command, environment = setup.environment;
    std::vector<char*> words = pointers_to(command), surroundings = pointers_to(environment);
    words.push_back(nullptr);
    // Of two variables with one name, programs find the first.
    for (char** entry = environ; *entry != nullptr; ++entry) surroundings.push_back(*entry);
    surroundings.push_back(nullptr);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    if (setup.own_group) posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int code =
        posix_spawnp(&pid_, words[0], &actions, &attributes, words.data(), surroundings.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (code == 0) return;
    pid_ = -1;
    throw IoError("cannot start the program " + command[0] + " (" + std::strerror(code) + ")");
}

Child::~Child() {
    if (pid_ <= 0) return;
    kill(own_group_ ? -pid_ : pid_, SIGKILL);
    wait();
}

int Child::wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
}

std::optional<int> Child::ended() {
    siginfo_t info{};
    const auto process = static_cast<id_t>(pid_);
    if (waitid(P_PID, process, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != pid_)
        return std::nullopt;
    if (own_group_) kill(-pid_, SIGKILL);  // what it has started and left
    return wait();
}

ProgramResult run_to_end(const std::vector<std::string>& command, std::string_view input,
                         std::chrono::seconds limit, const Progress& progress) {
    constexpr auto kPoll = std::chrono::milliseconds(2);
    const Descriptor in = memory_file("vesselbench-in"), out = memory_file("vesselbench-out"),
                     err = memory_file("vesselbench-err");
    write_all(in.number(), std::as_bytes(std::span(input)));
    lseek(in.number(), 0, SEEK_SET);
    Child child({.command = command,
                 .ends = {{in.number(), STDIN_FILENO},
                          {out.number(), STDOUT_FILENO},
                          {err.number(), STDERR_FILENO}},
                 .environment = {"LC_ALL=C", "TZ=UTC0"}});
    const auto deadline = std::chrono::steady_clock::now() + limit;
    std::optional<int> status;
    while (!(status = child.ended())) {
        progress.check_cancelled();
        if (std::chrono::steady_clock::now() >= deadline)
            throw AlgorithmFailure(command[0] + " took longer than " +
                                   std::to_string(limit.count()) + " s");
        std::this_thread::sleep_for(kPoll);
    }
    return {exit_code_of(*status), content_of(out), content_of(err)};
}

}  // namespace vesselbench
