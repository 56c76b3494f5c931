#include "workbench/commands/console/crash_report.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <functional>
#include <system_error>

#include <execinfo.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "workbench/case/version.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

constexpr std::array kCrashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr std::size_t kMostCalls = 64;

// Sanitizers report crashes better, and by the same signals.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// All that the handler needs, made before: it may neither allocate nor lock.
struct Prepared {
    std::vector<std::string> folders;  ///< from the outermost that may be missing
    std::string file, head, told;
};

const Prepared* prepared = nullptr;  // NOLINT: a handler can only access globals

void write_text(int file, const char* text) {
    for (std::size_t left = std::strlen(text); left > 0;) {
        const ssize_t written = ::write(file, text, left);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        text += written;
        left -= static_cast<std::size_t>(written);
    }
}

const char* name_of(int signal) {
    switch (signal) {
        case SIGSEGV:
            return "SIGSEGV (memory that is not its own)\n";
        case SIGBUS:
            return "SIGBUS (memory or a mapped file that is gone)\n";
        case SIGFPE:
            return "SIGFPE (arithmetic)\n";
        case SIGILL:
            return "SIGILL (an instruction that this processor lacks)\n";
        default:
            return "SIGABRT (a failed check, or an error that nobody handled)\n";
    }
}

bool write_report(int signal) {
    for (const std::string& folder : prepared->folders) ::mkdir(folder.c_str(), 0700);
    const int file = ::open(prepared->file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return false;
    write_text(file, prepared->head.c_str());
    write_text(file, "signal:  ");
    write_text(file, name_of(signal));
    write_text(file, "calls, the last one first:\n");
    std::array<void*, kMostCalls> calls = {};
    const int count = ::backtrace(calls.data(), static_cast<int>(calls.size()));
    ::backtrace_symbols_fd(calls.data(), count, file);
    ::close(file);
    return true;
}

extern "C" void report_crash(int signal) {
    // SA_RESETHAND has restored the default: another crash in here, and raise() below, end the
    // program.
    const bool written = write_report(signal);
    write_text(STDERR_FILENO,
               "\nvesselbench: the program crashed; projects keep every edit that "
               "was finished");
    if (written) write_text(STDERR_FILENO, prepared->told.c_str());
    write_text(STDERR_FILENO, "\n");
    ::raise(signal);
}

std::vector<std::string> with_parents(const fs::path& folder) {
    std::vector<std::string> folders;
    for (fs::path path = folder; path.has_relative_path(); path = path.parent_path())
        folders.insert(folders.begin(), path.string());
    return folders;
}

std::string head(const std::string& command) {
    utsname system = {};
    ::uname(&system);
    return "vesselbench " + version() + "\nsystem:  " + system.sysname + " " + system.release +
           " " + system.machine + "\ncommand: " + command + "\nstarted: " + utc_now() + "\n";
}

/// An overflown stack has no room for the handler.
void give_handlers_a_stack() {
    constexpr std::size_t kSize = 1U << 16U;
    static std::array<std::byte, kSize> memory;
    const stack_t stack = {.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
    ::sigaltstack(&stack, nullptr);
}

}  // namespace

void report_crashes(const fs::path& folder, const std::string& command) {
    if (kSanitized) return;
    std::string when = utc_now();
    std::erase(when, ':');
    const std::string file =
        (folder / ("crash-" + when + "-" + std::to_string(::getpid()) + ".txt")).string();
    static Prepared all;
    all = {with_parents(folder), file, head(command),
           ".\nWhat it was doing is written to " + file +
               ", which is sent nowhere; please report the crash with it."};
    prepared = &all;
    std::array<void*, 1> first = {};
    ::backtrace(first.data(), 1);  // loads what it needs: a handler must not
    give_handlers_a_stack();
    struct sigaction action = {};
    action.sa_handler = report_crash;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK);
    for (const int signal : kCrashes) ::sigaction(signal, &action, nullptr);
}

std::vector<fs::path> crash_reports(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().filename().string().starts_with("crash-")) files.push_back(entry.path());
    std::ranges::sort(files, std::greater());
    return files;
}

std::optional<fs::path> untold_crash(const fs::path& folder) {
    const std::vector<fs::path> reports = crash_reports(folder);
    if (reports.empty()) return std::nullopt;
    const fs::path told = folder / "told";
    const std::string newest = reports.front().filename().string();
    std::string last;
    std::getline(std::ifstream(told), last);
    if (last == newest) return std::nullopt;
    std::ofstream(told) << newest << "\n";
    return reports.front();
}

}  // namespace vesselbench
