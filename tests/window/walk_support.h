#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "tests/window/driver.h"

namespace vesselbench::test {

/// The document of a driven window.
[[nodiscard]] const Document& document_of(Driver& window);

/// Number of edits in the current state.
[[nodiscard]] std::size_t edit_count(Driver& window);

/// Opens a file as if it were dropped on the window, and waits for its model.
void open_file(Driver& window, const std::string& file);

/// Goes to a step in the rail, and chooses one of its operations.
void choose(Driver& window, const std::string& step, const std::string& operation);

/// Presses Apply (or Change), and waits for the edit. \return the command of the form
std::string apply_form(Driver& window);

/// Where a point is seen in the window [pixels].
[[nodiscard]] Eigen::Vector2f seen_at(Driver& window, const Vec3& point);

/// Lets the pointer rest over the view, so that its keys act.
void point_at_view(Driver& window);

/// Picks the vessel end next to a point as the value of a parameter.
void pick_end(Driver& window, const std::string& parameter, const Vec3& near);

/// Draws a stroke along a line that is seen, and waits for its edit.
void stroke(Driver& window, const Vec3& from, const Vec3& to);

/// An edit as a command on its project.
[[nodiscard]] std::string command_of(const LogEntry& edit, const std::string& project);

/// Exports by the window's dialog to a file beside the project.
void export_as(Driver& window, const std::string& name);

/// The log as a new session of its own reads it from the file.
[[nodiscard]] std::vector<LogEntry> stored_log(const std::filesystem::path& project);

/// Memory of this process [MB], without what its allocator keeps for later.
[[nodiscard]] double resident_megabytes();

}  // namespace vesselbench::test
