#pragma once

#include "geometry/kernel/errors.h"

namespace vesselbench {

/// Throws what a reader said of a file as an error with a code, "file-not-read", and with what to
/// do about the file unless the reader says it; an error that has a code stays as it is.
[[noreturn]] void throw_unreadable(const InvalidInput& error);

/// What a reader gives. \throw InvalidInput with a code
template <class Read>
[[nodiscard]] auto read_or_explain(const Read& read) {
    try {
        return read();
    } catch (const InvalidInput& error) {
        throw_unreadable(error);
    }
}

}  // namespace vesselbench
