#pragma once

#include <functional>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/progress.h"
#include "workbench/prepare/recipe.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// Receives messages about a recipe's edits, one line of text at a time.
using Teller = std::function<void(const std::string&)>;

/// The loaded surface cannot be repaired: the input is bad, not the recipe.
class UnusableSource : public InvalidInput {
public:
    using InvalidInput::InvalidInput;
};

/// Applies a recipe's entries to a session, one edit each, in their order.
/// \param variant of the edits of steps 4-8
/// \return warnings in addition to those of the edits
/// \throw what an edit throws; UnusableSource. The session keeps the edits that were done
std::vector<std::string> apply_recipe(Session& session, const Recipe& recipe,
                                      const std::string& variant, const Teller& tell,
                                      const Progress& progress);

}  // namespace vesselbench
