#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// A file descriptor that is closed with its owner.
class Descriptor {
public:
    /// \throw IoError if the number is negative: too many files are open
    explicit Descriptor(int number);

    ~Descriptor() { reset(); }

    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

    Descriptor& operator=(Descriptor&&) = delete;

    [[nodiscard]] int number() const { return number_; }

    void reset();

private:
    int number_;
};

/// The same file under a number that no child's end has. The given number is closed.
[[nodiscard]] Descriptor moved_up(int number);

/// A file in memory, empty, which a child can be given.
[[nodiscard]] Descriptor memory_file(const char* name);

/// \throw IoError if there is no memory left, or it is more than files may have (RLIMIT_FSIZE, of
/// which SIGXFSZ is ignored)
void write_all(int descriptor, std::span<const std::byte> bytes);

/// How a child is started.
struct ChildSetup {
    std::vector<std::string> command;  ///< a program, looked up in PATH if it names no folder, and
                                       ///< its arguments, which no shell reads
    /// Open files of this process, and their numbers in the child, below 10. Its input, output and
    /// errors are /dev/null otherwise; all other numbers are closed.
    std::vector<std::pair<int, int>> ends;
    std::vector<std::string> environment;  ///< "NAME=VALUE", in place of what this process has
    bool own_group = false;  ///< signals of the terminal do not reach it; it ends with its group
};

/// Another program as a process, killed and reaped with its owner.
class Child {
public:
    /// \throw IoError if it cannot be started
    explicit Child(const ChildSetup& setup);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// The process's id.
    [[nodiscard]] int number() const { return pid_; }

    /// Waits for its end. \return its status from waitpid()
    int wait();

    /// The same without waiting; none: it runs.
    [[nodiscard]] std::optional<int> ended();

private:
    int pid_ = -1;
    bool own_group_ = false;
};

/// What a program left that ran to its end.
struct ProgramResult {
    int exit_code = 0;     ///< 128 + signal if it was killed
    std::string out, err;  ///< the first 64 KiB of each
};

/// Runs a program that ends by itself, with English texts and UTC times.
/// \param command as ChildSetup's
/// \throw IoError if it cannot be started; AlgorithmFailure if it does not end within the limit;
/// Cancelled; it is then killed
[[nodiscard]] ProgramResult run_to_end(const std::vector<std::string>& command,
                                       std::string_view input, std::chrono::seconds limit,
                                       const Progress& progress = {});

}  // namespace vesselbench
