#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workbench/session/snapshot.h"

namespace vesselbench {

/// What a project was prepared for. A model that shared steps alone make has no edits of its own to
/// show it.
struct PreparedPurposes {
    std::vector<std::string> done;  ///< purposes whose model was made, each once
    std::string last;               ///< the last one, whose model may be incomplete; empty: none
};

/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] PreparedPurposes prepared_purposes(const std::filesystem::path& project);

/// A preparation for a purpose has begun: edits by hand are of its variant where they name none.
/// \throw IoError if the project cannot be written
void begin_purpose(const std::filesystem::path& project, const std::string& purpose);

/// Its model was made. \throw as begin_purpose()
void end_purpose(const std::filesystem::path& project, const std::string& purpose);

/// The variant that is meant where `asked` is empty: the purpose that the project was prepared for
/// last, else as variant_meant().
/// \throw UsageError if the project has no variant that is asked for, and was not prepared for it;
/// as prepared_purposes()
[[nodiscard]] std::string variant_of(const std::filesystem::path& project, const std::string& asked,
                                     const History& history);

/// The purposes with a model and the variants with edits, beside one.
[[nodiscard]] std::vector<std::string> other_purposes(const Snapshot& now,
                                                      std::vector<std::string> done,
                                                      const std::string& purpose);

}  // namespace vesselbench
