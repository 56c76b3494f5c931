#include "workbench/commands/console/messages.h"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <mutex>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/commands/console/progress_line.h"
#include "workbench/project/utc_time.h"
#include "workbench/session/monotone_progress.h"

namespace vesselbench {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kBarInterval = 100ms;  ///< on a terminal
constexpr auto kLineInterval = 10s;   ///< in files

constexpr std::string_view kRed = "\033[1;31m", kYellow = "\033[1;33m", kPlain = "\033[0m";

bool has_text(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

bool is_dumb() {
    const char* terminal = std::getenv("TERM");
    return terminal != nullptr && std::string_view(terminal) == "dumb";
}

std::size_t terminal_width() {
    constexpr std::size_t kUsual = 80;
    winsize size = {};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 8;
    return known ? size.ws_col : kUsual;
}

/// All that goes to stderr, of the whole process.
class Messages {
public:
    Messages() {
        // The bar's line belongs to the results as soon as they are written.
        if (on_terminal_) std::cout.tie(&eraser_);
    }

    ~Messages() {
        if (std::cout.tie() == &eraser_) std::cout.tie(nullptr);
    }

    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;

    void set(const MessageOptions& options) {
        const std::scoped_lock lock(mutex_);
        quiet_ = options.quiet;
        if (options.log.empty()) return;
        log_.open(options.log, std::ios::app);
        if (!log_) throw IoError("the log '" + printable(options.log) + "' cannot be written");
    }

    /// \param kind "warning: ", shown in the colour; empty: a remark
    void line(std::string_view kind, std::string_view colour, const std::string& text, bool error) {
        const std::scoped_lock lock(mutex_);
        const std::string shown = printable(text);
        write_log(std::string(kind) + shown);
        if (quiet_ && !error) return;
        erase();
        const bool coloured = coloured_ && !kind.empty();
        write((coloured ? std::string(colour) : "") + std::string(kind) +
              (coloured ? std::string(kPlain) : "") + shown + "\n");
    }

    void progress(double fraction, std::string_view what) {
        const std::scoped_lock lock(mutex_);
        const Clock::time_point now = Clock::now();
        const double elapsed = std::chrono::duration<double>(now - begin_).count();
        if (now - bar_ >= kBarInterval && on_terminal_ && !quiet_) {
            bar_ = now;
            erase();
            write(progress_bar(fraction, what, elapsed, terminal_width() - 4));
            has_bar_ = true;
        }
        if (now - line_ < kLineInterval) return;
        line_ = now;
        write_log(progress_text(fraction, what, elapsed));
        if (!on_terminal_ && !quiet_) write(progress_text(fraction, what, elapsed) + "\n");
    }

    void note(const std::string& text) {
        const std::scoped_lock lock(mutex_);
        write_log(printable(text));
    }

    void erase_bar() {
        const std::scoped_lock lock(mutex_);
        erase();
    }

private:
    /// A stream whose flush erases the bar: std::cout flushes the stream it is tied to before it
    /// writes.
    class Eraser : public std::streambuf {
    public:
        explicit Eraser(Messages& messages) : messages_(messages) {}

    protected:
        int sync() override {
            messages_.erase_bar();
            return 0;
        }

    private:
        Messages& messages_;
    };

    void erase() {
        if (std::exchange(has_bar_, false)) write("\r\033[K");
    }

    /// Not by std::cerr, which flushes std::cout, whose flush erases the bar.
    static void write(const std::string& text) { std::fputs(text.c_str(), stderr); }

    void write_log(const std::string& text) {
        if (log_.is_open()) log_ << utc_now() << " " << text << std::endl;
    }

    std::mutex mutex_;
    std::ofstream log_;
    bool quiet_ = false, has_bar_ = false;
    const bool on_terminal_ = ::isatty(STDERR_FILENO) == 1 && !is_dumb();
    const bool coloured_ = on_terminal_ && !has_text("NO_COLOR");
    const Clock::time_point begin_ = Clock::now();
    Clock::time_point bar_ = begin_, line_ = begin_;  ///< when they were written last
    Eraser eraser_buffer_{*this};
    std::ostream eraser_{&eraser_buffer_};
};

Messages& messages() {
    static Messages all;
    return all;
}

}  // namespace

void set_messages(const MessageOptions& options) {
    messages().set(options);
}

void note_in_log(const std::string& text) {
    messages().note(text);
}

void complain(const std::string& text) {
    messages().line("vesselbench: ", kRed, text, true);
}

void warn(const std::string& text) {
    messages().line("warning: ", kYellow, text, false);
}

void remark(const std::string& text) {
    messages().line("", "", text, false);
}

Progress console_progress(std::stop_token stop) {
    const auto show = [](double fraction, std::string_view what) {
        messages().progress(fraction, what);
    };
    return {monotone(show), std::move(stop)};
}

}  // namespace vesselbench
