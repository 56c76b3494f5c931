#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Turns SIGINT and SIGTERM into a stop request for as long as it lives; a second signal ends the
/// program at once.
class SignalStop {
public:
    SignalStop();
    ~SignalStop();
    SignalStop(const SignalStop&) = delete;
    SignalStop& operator=(const SignalStop&) = delete;

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

private:
    struct Listener;
    std::stop_source source_;
    std::unique_ptr<Listener> listener_;
};

/// Shows progress as one changing line on stderr if that is a terminal, else nothing.
[[nodiscard]] Progress console_progress(std::stop_token stop);

/// Writes the line "vesselbench: text" to stderr: why the program failed.
void complain(const std::string& text);

/// Writes one line to stderr: a remark or a warning. Control characters are shown escaped.
void remark(const std::string& text);

/// Rows as left-aligned columns, two spaces apart; the last column is wrapped to a width of 100
/// characters. Control characters are shown escaped.
[[nodiscard]] std::string as_columns(const std::vector<std::vector<std::string>>& texts);

}  // namespace vesselbench
