#pragma once

#include <string>

#include "workbench/review/audit.h"

namespace vesselbench {

/// An entry in words: "smooth (smoothing, cfd)", "A. Kern: 3 accept, 1 reject".
[[nodiscard]] std::string entry_words(const ChainEntry& entry);

/// The audit as a document for programs, and as a page for people, which holds no script and loads
/// nothing.
[[nodiscard]] nlohmann::ordered_json audit_json(const Audit& audit);
[[nodiscard]] std::string audit_html(const Audit& audit);

}  // namespace vesselbench
