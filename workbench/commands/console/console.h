#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace vesselbench {

/// Turns SIGINT, SIGTERM and SIGHUP into a stop request for as long as it lives. Another one ends
/// the program at once if it comes at least 2 s after the first: some senders send two in a row
/// (coreutils' timeout: to its child, then to its group). A signal that the program was started to
/// ignore (a shell's background job, nohup) stays ignored. If the system has no pipe or thread left
/// for it, the signals end the program, as they do without it.
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

/// Rows as left-aligned columns, two spaces apart; the last column is wrapped to a width of 100
/// characters. Control characters are shown escaped.
[[nodiscard]] std::string as_columns(const std::vector<std::vector<std::string>>& texts);

}  // namespace vesselbench
