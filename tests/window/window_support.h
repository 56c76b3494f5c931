#pragma once

#include <memory>
#include <string>

#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::test {

/// The real operations, run by the program's workers.
[[nodiscard]] SessionOptions session_options();

/// Options whose settings and new projects are in folders of their own.
[[nodiscard]] AppOptions app_options();

/// A closed tube of 4 mm radius as an STL file in a new folder.
/// \param around vertices around it, a multiple of 6
[[nodiscard]] std::string tube_file(int around = 24);

/// Fails the test: what OpenGL reports is a defect.
void fail_on_report(const std::string& text);

/// A shell of 1280 x 720, whose OpenGL errors fail the test; null where there is no OpenGL: the
/// scenario counts as skipped.
[[nodiscard]] std::unique_ptr<OffscreenShell> test_shell();

/// Opens a file and waits for it.
void open_and_wait(OffscreenShell& shell, const std::string& file);

/// Draws frames until no request runs. \return false if that takes too long
bool wait_until_idle(OffscreenShell& shell);

}  // namespace vesselbench::test
