#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

#include "geometry/kernel/errors.h"
#include "workbench/commands/command_line.h"
#include "workbench/commands/console.h"
#include "workbench/operations/table.h"
#include "workbench/worker/worker.h"

namespace {

/// Exit codes are a contract (DESIGN 4).
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;

int tell(const char* text, int code) {
    vesselbench::complain(text);
    return code;
}

int run(int argc, char** argv) {
    try {
        const vesselbench::SignalStop signals;
        return vesselbench::run_command_line(argc, argv, signals.token());
    } catch (const vesselbench::UsageError& error) {
        return tell(error.what(), kWrongUsage);
    } catch (const vesselbench::InvalidInput& error) {
        return tell(error.what(), kBadInput);
    } catch (const vesselbench::IoError& error) {
        return tell(error.what(), kBadInput);
    } catch (const std::bad_alloc&) {
        return tell("not enough memory for this model: crop it or make it coarser", kFailed);
    } catch (const std::exception& error) {
        return tell(error.what(), kFailed);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string_view(argv[1]) == "--worker") {
        std::signal(SIGINT,
                    SIG_IGN);  // a terminal signals all processes; the session ends its worker
        return vesselbench::worker_main(vesselbench::find_operation);
    }
    // A full disk or a closed pipe then causes a failed write, which is reported and cleaned
    // up.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    const int code = run(argc, argv);
    if (std::fflush(stdout) != 0 && code == 0)
        return tell("the output could not be written", kBadInput);
    return code;
}
