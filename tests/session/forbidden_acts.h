#pragma once

#include "workbench/case/operation.h"

namespace vesselbench::test {

/// An operation that tries what a damaged file may make its reader do.
/// Arguments: `what`: "read", "list", "write", "make", "remove" or "chmod" the file or folder `at`;
/// "read in a thread"; "socket", "exec", "fork", "signal" (to the parent process), "calculate"
/// (with all processors, which has to be possible); `file`: what it may read.
/// \return its warning is the error's number, 0 if it could be done
[[nodiscard]] Outcome forbidden_act(const Scene& scene, const Arguments& arguments, Progress&);

}  // namespace vesselbench::test
