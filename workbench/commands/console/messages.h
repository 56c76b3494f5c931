#pragma once

#include <stop_token>
#include <string>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Where messages go besides stderr, and which.
struct MessageOptions {
    bool quiet = false;  ///< stderr gets errors only
    std::string log;     ///< file that all messages and the progress are appended to; empty: none
};

/// Applies to all messages that follow.
/// \throw IoError if the log cannot be written
void set_messages(const MessageOptions& options);

/// Writes a line to the log alone, if there is one.
void note_in_log(const std::string& text);

/// Writes the line "vesselbench: text" to stderr: why the program failed.
void complain(const std::string& text);

/// Writes the line "warning: text" to stderr.
void warn(const std::string& text);

/// Writes one line to stderr: what was done, or a remark.
void remark(const std::string& text);

/// Shows progress on stderr: a bar with the time left if that is a terminal, else a line from time
/// to time, so that a log of a long step shows that it goes on. Thread-safe.
///
/// All of these show control characters escaped, and colours only on a terminal, unless the
/// environment has NO_COLOR (https://no-color.org).
[[nodiscard]] Progress console_progress(std::stop_token stop);

}  // namespace vesselbench
