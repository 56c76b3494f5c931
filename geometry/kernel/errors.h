#pragma once

#include <stdexcept>
#include <string>

namespace vesselbench {

/// A parameter or a command is used incorrectly (exit code 2). The text names the parameter, the
/// value and the range.
class UsageError : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// The input data cannot be used (exit code 3). The text names the file or the place, and the
/// remedy.
class InvalidInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// A file cannot be read or written (exit code 3). The text names the file without its folder's
/// parents, and the cause.
class IoError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The operation is valid, but cannot be done on this model (exit code 1). The text says why, where
/// and what to try.
class AlgorithmFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// There is no usable OpenGL context; the text says what is missing. Pictures and GPU paths are
/// skipped; the CPU takes over.
class GpuUnavailable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The user cancelled; the scene is unchanged (exit code 1).
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace vesselbench
