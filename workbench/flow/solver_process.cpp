#include "workbench/flow/solver_process.h"

#include <chrono>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/worker/child_process.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kSolverPoll = 20ms;  ///< how soon a cancel is heard
constexpr auto kWatch = 200ms;      ///< between two looks at the tables
constexpr std::size_t kLastLines = 6;

/// Where Debian has what its programs look for.
constexpr const char* kProjectFolder = "/usr/share/openfoam";

/// The log, locked for as long as it or a child's copy of it is open.
Descriptor locked_log(const fs::path& file) {
    const int number = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (number < 0) throw IoError("'" + bare_name(file) + "' cannot be written");
    Descriptor log = moved_up(number);
    if (::flock(log.number(), LOCK_EX | LOCK_NB) != 0)
        throw InvalidInput("another process runs this case: wait for its end");
    if (::ftruncate(log.number(), 0) != 0)
        throw IoError("'" + bare_name(file) + "' cannot be written");
    return log;
}

/// The end of a log, in one line.
std::string last_lines(const fs::path& file) {
    std::istringstream stream(file_content(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        if (line.find_first_not_of(" \t") != std::string::npos)
            lines.push_back(line.substr(line.find_first_not_of(" \t")));
    const std::size_t first = lines.size() > kLastLines ? lines.size() - kLastLines : 0;
    return printable(joined(std::span(lines).subspan(first), " | "));
}

/// With it, the program ends when this one does, however that ends.
std::vector<std::string> ending_with_us(std::vector<std::string> command) {
    command.insert(command.begin(), {"setpriv", "--pdeathsig", "KILL"});
    return command;
}

std::vector<std::string> solver_environment() {
    std::vector<std::string> environment = {"LC_ALL=C",
                                            "OMPI_MCA_rmaps_base_oversubscribe=1",
                                            "OMPI_MCA_mpi_yield_when_idle=1",
                                            "OMPI_ALLOW_RUN_AS_ROOT=1",
                                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                            "OMPI_MCA_hwloc_base_binding_policy=none"};
    if (std::getenv("WM_PROJECT_DIR") == nullptr && fs::is_directory(kProjectFolder))
        environment.push_back(std::string("WM_PROJECT_DIR=") + kProjectFolder);
    return environment;
}

}  // namespace

fs::path installed_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::error_code ignored;
        const fs::path file = fs::path(folder) / name;
        if (fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

void run_solver(const fs::path& folder, const std::vector<std::string>& command,
                const std::string& log, const std::function<void()>& watch,
                const Progress& progress) {
    const fs::path file = folder / ("log." + log);
    const Descriptor output = locked_log(file);
    Child child({.command = ending_with_us(command),
                 .ends = {{output.number(), STDOUT_FILENO}, {output.number(), STDERR_FILENO}},
                 .environment = solver_environment(),
                 .own_group = true});
    auto watched = std::chrono::steady_clock::now();
    std::optional<int> status;
    while (!(status = child.ended())) {
        progress.check_cancelled();
        if (const auto now = std::chrono::steady_clock::now(); now - watched >= kWatch) {
            watched = now;
            watch();
        }
        std::this_thread::sleep_for(kSolverPoll);
    }
    if (WIFEXITED(*status) && WEXITSTATUS(*status) == 0) return;
    throw AlgorithmFailure(command.front() + " failed; its last lines (log." + log +
                           " has all): " + last_lines(file));
}

}  // namespace vesselbench
