#pragma once

#include <string>
#include <vector>

namespace vesselbench::test {

/// A program that runs beside the test; it ends with the test at the latest. Its standard output
/// can be read here, its standard error is the test's.
class ChildProcess {
public:
    /// \param program path
    /// \param unread bytes of its output that it can write before it waits for line(); at least a
    /// page of memory
    ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                 int unread = 1 << 16);
    ~ChildProcess();

    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Waits for the next line of its output. Empty at the end of the output.
    [[nodiscard]] std::string line();

    void signal(int number);

    /// True if the process has a handler for the signal: not if it ignores it or dies of it.
    [[nodiscard]] bool handles(int number) const;

    /// Waits for its end. \return its exit code; 128 + signal if it was killed
    int wait();

private:
    int pid_ = -1, output_ = -1;
};

}  // namespace vesselbench::test
