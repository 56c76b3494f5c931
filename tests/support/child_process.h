#pragma once

#include <string>
#include <vector>

namespace vesselbench::test {

/// A program that runs beside the test; it ends with the test at the latest. Its standard output
/// can be read here, its standard error is the test's.
class ChildProcess {
public:
    /// \param program path
    ChildProcess(const std::string& program, const std::vector<std::string>& arguments);
    ~ChildProcess();

    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Waits for the next line of its output. Empty at the end of the output.
    [[nodiscard]] std::string line();

    void signal(int number);

    /// Waits for its end. \return its exit code; 128 + signal if it was killed
    int wait();

private:
    int pid_ = -1, output_ = -1;
};

}  // namespace vesselbench::test
