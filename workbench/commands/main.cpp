#include <csignal>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/batch/case_process.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/commands/command_line.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/commands/failure.h"
#include "workbench/operations/table.h"
#include "workbench/worker/worker.h"

namespace {

/// Exit codes are a contract (DESIGN 4).
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kBadInput = 3;

int run(int argc, char** argv, const std::stop_token& stop) {
    vesselbench::FailedCommand command;
    const auto fail = [&](const std::exception& error, int code) {
        std::vector<vesselbench::Diagnostic> diagnostics;
        if (dynamic_cast<const vesselbench::Diagnosed*>(&error) != nullptr)
            diagnostics = vesselbench::diagnostics_of(error);
        for (vesselbench::Diagnostic& diagnostic : diagnostics)
            if (!diagnostic.edit) diagnostic.edit = command.edit;
        const std::string text = diagnostics.empty()
                                     ? error.what()
                                     : worded_with_operation(diagnostics.front(), command.audience);
        return vesselbench::report_failure({text, code, diagnostics}, command);
    };
    const auto fail_with = [&](const std::string& text, int code) {
        return vesselbench::report_failure({text, code, {}}, command);
    };
    const auto cancelled = [&] {
        return vesselbench::report_failure(
            {.text = "stopped (cancelled); what was finished before is kept",
             .code = kFailed,
             .cancelled = true},
            command);
    };
    try {
        return vesselbench::run_command_line(argc, argv, stop, command);
    } catch (const vesselbench::UsageError& error) {
        return fail(error, kWrongUsage);
    } catch (const vesselbench::InvalidInput& error) {
        return fail(error, kBadInput);
    } catch (const vesselbench::Cancelled&) {
        return cancelled();
    } catch (const vesselbench::IoError& error) {
        return fail(error, kBadInput);
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string name = vesselbench::bare_name(error.path1());
        return fail_with(name + " cannot be used (" + error.code().message() +
                             "): check its name and the permissions of its folders",
                         kBadInput);
    } catch (const nlohmann::json::exception&) {
        return fail_with("stored or given JSON data are not as expected", kFailed);
    } catch (const std::bad_alloc&) {
        return fail_with("not enough memory for this model: crop it or make it coarser", kFailed);
    } catch (const std::exception& error) {
        return fail(error, kFailed);
    }
}

/// The exit code of a command that ended with `code`, once its output has left: a full disk or a
/// closed pipe may refuse it as late as here.
int with_output_written(int code) {
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    if (code != 0 || (flushed && std::cout && std::ferror(stdout) == 0)) return code;
    vesselbench::complain(
        "the output could not be written: its disk is full, or its reader has ended");
    return kFailed;
}

/// Eigen sums large products in blocks of a length that depends on the processor's caches. Blocks
/// for the same caches give the same bits everywhere, so that stored edits replay.
void fix_sums() {
    constexpr std::ptrdiff_t kKiB = 1024, kMiB = 1024 * kKiB;
    Eigen::setCpuCacheSizes(48 * kKiB, kMiB, 32 * kMiB);
}

}  // namespace

int main(int argc, char** argv) {
    fix_sums();
    if (argc == 2 && std::string_view(argv[1]) == "--worker") {
        // Sent to the whole group: the session stops and ends its worker itself.
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
        return vesselbench::worker_main(vesselbench::find_operation);
    }
    vesselbench::enter_case_process(argc, argv);
    // A full disk or a closed pipe then causes a failed write, which is reported and cleaned
    // up.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    const vesselbench::SignalStop signals;
    const int code = with_output_written(run(argc, argv, signals.token()));
    vesselbench::note_in_log("end: exit code " + std::to_string(code));
    return code;
}
