#include "workbench/commands/console/console.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <sstream>
#include <system_error>
#include <thread>

#include <time.h>
#include <unistd.h>

#include "geometry/kernel/printable.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLineWidth = 100;

/// The writing end of the signal handler's pipe; -1 while nobody listens. A handler can only access
/// globals.
volatile std::sig_atomic_t signal_pipe = -1;  // NOLINT

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP};

/// Signals this soon after the first are its repetitions, not a user who lost patience [ns].
constexpr std::int64_t kRepetitions = 2'000'000'000;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
std::atomic<std::int64_t> first_signal = kNever;  // NOLINT: when it came [ns]
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "for a signal handler");

/// Monotonic time [ns]; a signal handler may call it.
std::int64_t now_in_handler() {
    timespec now = {};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

extern "C" void tell_pipe(int signal) {
    const std::int64_t now = now_in_handler();
    std::int64_t first = kNever;
    if (!first_signal.compare_exchange_strong(first, now)) {
        if (now - first >= kRepetitions) ::_exit(128 + signal);
        return;
    }
    const char letter = 's';
    if (signal_pipe >= 0 && ::write(signal_pipe, &letter, 1) != 1) ::_exit(128 + signal);
}

bool is_ignored(int signal) {
    struct sigaction action = {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Gives the stop signals that are not ignored to `handler`.
void handle_stop_signals(void (*handler)(int)) {
    for (const int signal : kStopSignals)
        if (!is_ignored(signal)) std::signal(signal, handler);
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width)
            lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
}

std::vector<std::size_t> column_widths(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    return widths;
}

}  // namespace

struct SignalStop::Listener {
    int ends[2] = {-1, -1};
    std::thread thread;
};

SignalStop::SignalStop() : listener_(std::make_unique<Listener>()) {
    if (::pipe(listener_->ends) != 0) return;
    signal_pipe = listener_->ends[1];
    try {
        listener_->thread = std::thread([this] {
            char letter = 0;
            if (::read(listener_->ends[0], &letter, 1) == 1 && letter == 's')
                source_.request_stop();
        });
    } catch (const std::system_error&) {
        return;
    }
    handle_stop_signals(tell_pipe);
}

SignalStop::~SignalStop() {
    if (!listener_->thread.joinable()) return;
    handle_stop_signals(SIG_DFL);
    const char letter = 'q';
    if (::write(listener_->ends[1], &letter, 1) != 1) std::terminate();
    listener_->thread.join();
    signal_pipe = -1;
    ::close(listener_->ends[0]);
    ::close(listener_->ends[1]);
}

std::string as_columns(const std::vector<std::vector<std::string>>& texts) {
    std::vector<std::vector<std::string>> rows = texts;
    for (auto& row : rows)
        for (std::string& cell : row) cell = printable(cell);
    const std::vector<std::size_t> widths = column_widths(rows);
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t c = 0; c + 1 < row.size(); ++c)
            line += row[c] + std::string(widths[c] + 2 - row[c].size(), ' ');
        const std::size_t indent = line.size();
        const std::size_t room = kLineWidth > indent + 30 ? kLineWidth - indent : 30;
        for (const std::string& part : wrapped(row.empty() ? "" : row.back(), room)) {
            text += line + part + "\n";
            line.assign(indent, ' ');
        }
    }
    return text;
}

}  // namespace vesselbench
