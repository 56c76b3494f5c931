#pragma once

#include <filesystem>
#include <vector>

namespace vesselbench {

/// The parts of a sandbox; a kernel or a container may offer only some of them.
struct Sandbox {
    bool files = false;  ///< Landlock: which files can be opened
    bool calls = false;  ///< a seccomp filter: which system calls are refused
};

/// What enter_sandbox() can do here. Changes nothing.
[[nodiscard]] Sandbox available_sandbox();

/// Gives up, for good, what reading a foreign file and computing with it do not need. With `files`,
/// only `readable` and the system's libraries can be opened, and only for reading. With `calls`,
/// there is no network, no other program, no new process, no signal to another process, and no
/// change of a file's owner, permissions or times; such calls fail with EPERM. What is open already
/// stays usable. Holds for the calling thread and those it starts: call it before the first.
/// \param readable files, and folders with all that is in them; missing ones are left out
/// \return the parts that are in force: what the kernel refuses is left out
Sandbox enter_sandbox(const std::vector<std::filesystem::path>& readable);

}  // namespace vesselbench
