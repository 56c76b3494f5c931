#pragma once

#include <string>
#include <utility>

namespace vesselbench::test {

/// A temporary folder that can be put back as it was.
class KeptFolder {
public:
    KeptFolder();

    [[nodiscard]] const std::string& path() const { return path_; }

    void keep();           ///< remembers what is in it
    void restore() const;  ///< to what was kept, at the same path

private:
    std::string path_;
    std::string kept_;
};

/// What the leaves of a scenario begin with, made once: Catch runs a scenario from its start for
/// each leaf. A static local of the scenario:
///
///     static Beginning beginning([](const std::string& folder) { return run(... folder ...); });
///     const ProgramRun& result = beginning.again();
///
/// The value is what the function returned, and the folder is as the function left it, for every
/// leaf.
template <class Make>
class Beginning {
public:
    explicit Beginning(const Make& make) : value_(make(folder_.path())) { folder_.keep(); }

    [[nodiscard]] const std::string& folder() const { return folder_.path(); }

    [[nodiscard]] const auto& again() const {
        folder_.restore();
        return value_;
    }

private:
    KeptFolder folder_;
    decltype(std::declval<Make>()(std::string())) value_;
};

}  // namespace vesselbench::test
