#pragma once

#include <string>

#include "workbench/batch/batch_table.h"

namespace vesselbench {

/// table.html: one self-contained page, which sorts without a network. All texts are escaped, and
/// its policy (CSP) allows its own script and style alone.
[[nodiscard]] std::string table_page(const BatchTable& table);

}  // namespace vesselbench
