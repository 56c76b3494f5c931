#include "workbench/commands/console.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <sstream>
#include <thread>

#include <unistd.h>

#include "geometry/kernel/printable.h"
#include "workbench/session/monotone_progress.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLineWidth = 100;

/// The writing end of the signal handler's pipe; -1 while nobody listens. A handler can only access
/// globals.
volatile std::sig_atomic_t signal_pipe = -1;  // NOLINT
volatile std::sig_atomic_t signals_seen = 0;  // NOLINT

extern "C" void tell_pipe(int signal) {
    if (signals_seen != 0) ::_exit(128 + signal);
    signals_seen = 1;
    const char letter = 's';
    if (signal_pipe >= 0 && ::write(signal_pipe, &letter, 1) != 1) ::_exit(128 + signal);
}

bool on_terminal() {
    return ::isatty(STDERR_FILENO) == 1;
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
    listener_->thread = std::thread([this] {
        char letter = 0;
        if (::read(listener_->ends[0], &letter, 1) == 1 && letter == 's') source_.request_stop();
    });
    std::signal(SIGINT, tell_pipe);
    std::signal(SIGTERM, tell_pipe);
}

SignalStop::~SignalStop() {
    if (!listener_->thread.joinable()) return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    const char letter = 'q';
    if (::write(listener_->ends[1], &letter, 1) != 1) std::terminate();
    listener_->thread.join();
    signal_pipe = -1;
    ::close(listener_->ends[0]);
    ::close(listener_->ends[1]);
}

Progress console_progress(std::stop_token stop) {
    if (!on_terminal()) return {nullptr, std::move(stop)};
    const auto shown = std::make_shared<std::chrono::steady_clock::time_point>();
    const auto show = [shown](double fraction, std::string_view what) {
        const auto now = std::chrono::steady_clock::now();
        if (now - *shown < std::chrono::milliseconds(100)) return;
        *shown = now;
        std::fprintf(stderr, "\r\033[K%3.0f %%  %s", 100.0 * fraction, printable(what).c_str());
    };
    return {monotone(show), std::move(stop)};
}

void remark(const std::string& text) {
    std::fprintf(stderr, "%s%s\n", on_terminal() ? "\r\033[K" : "", printable(text).c_str());
}

void complain(const std::string& text) {
    remark("vesselbench: " + text);
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
