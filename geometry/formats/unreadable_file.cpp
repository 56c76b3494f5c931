#include "geometry/formats/unreadable_file.h"

#include <string>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

void throw_unreadable(const InvalidInput& error) {
    if (dynamic_cast<const Diagnosed*>(&error) != nullptr) throw;
    const std::string reason = error.what();
    Diagnostic diagnostic{.code = "file-not-read", .words = {{"reason", reason}}};
    // Readers that know more end with "; what to do", or ask to export or copy the file again.
    const bool advises =
        reason.find(';') != std::string::npos || reason.find("again") != std::string::npos;
    if (!advises)
        diagnostic.words["advice"] =
            "copy the file again, or export it again from the program that made it";
    throw DiagnosedInput(std::move(diagnostic));
}

}  // namespace vesselbench
