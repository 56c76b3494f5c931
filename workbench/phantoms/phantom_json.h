#pragma once

#include <string>
#include <vector>

#include "geometry/phantoms/description.h"

namespace vesselbench {

/// Reads a phantom's description (cases/phantoms/*.json; keys as the fields of PhantomDescription;
/// points of a vessel are [x, y, z, radius] in mm).
/// \throw InvalidInput that names the key and the value it needs
[[nodiscard]] PhantomDescription phantom_from_json(const std::string& text);

/// Names of the built-in phantoms, sorted.
[[nodiscard]] std::vector<std::string> phantom_names();

/// The built-in phantom of this name. \throw UsageError that lists the names if there is none
[[nodiscard]] PhantomDescription builtin_phantom(const std::string& name);

/// The phantom described in a .json file, or the built-in one of this name.
/// \throw IoError if the file cannot be read; InvalidInput; UsageError
[[nodiscard]] PhantomDescription phantom_named(const std::string& name);

}  // namespace vesselbench
