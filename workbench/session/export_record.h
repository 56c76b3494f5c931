#pragma once

#include <filesystem>
#include <string>

#include "workbench/session/session.h"

namespace vesselbench {

/// Enters into the project's record that a variant's model was written to a file or folder, with
/// its SHA-256.
/// \return false if the session only reads, and enters nothing
/// \throw IoError if the file or the project cannot be read or written
bool record_export(Session& session, const std::filesystem::path& file, const std::string& variant);

}  // namespace vesselbench
