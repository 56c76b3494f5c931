#pragma once

#include <filesystem>
#include <string>

#include "workbench/session/session.h"

namespace vesselbench::fuzz {

/// Small projects: a surface with edits of all kinds of state, and an image with its surface.
void write_project_specimens(const std::filesystem::path& folder);

/// The table's operations; this program runs their workers.
[[nodiscard]] SessionOptions session_options();

/// Opens a project, reads all of it and moves through its states.
/// \return what its current state holds: edits with arguments and the bits of the scenes; "" if an
/// edit is reported as not reproduced
/// \throw what Session throws
[[nodiscard]] std::string content_of(const std::filesystem::path& project);

/// Changes cells, rows or the schema of a project by SQL, as a stranger may.
void damage_rows(const std::filesystem::path& project, std::uint64_t seed);

}  // namespace vesselbench::fuzz
