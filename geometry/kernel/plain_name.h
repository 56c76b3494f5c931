#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// Names of patches, openings, attributes, neighbours and variants consist of ASCII letters,
/// digits, '_', '-' and '.'. They are written to files of other programs as they are, some of which
/// (OpenFOAM's dictionaries) run code that a name with other characters could contain.
[[nodiscard]] bool is_plain_name(std::string_view name);

/// "1 to 64 letters, digits, '_', '-' and '.'"
[[nodiscard]] std::string plain_name_rule();

/// \throw InvalidInput that shows the name and the rule, unless the name is plain
/// \param what has the name: "the patch"
void require_plain_name(std::string_view name, const std::string& what);

/// The last guard of writers. \throw InvalidInput unless all names are plain
void require_plain_names(std::span<const Patch> patches);

/// Turns names of foreign files into plain ones that differ from each other: the same names in the
/// same order always give the same result.
class PlainNames {
public:
    /// A plain name as it is; otherwise each run of other characters becomes one '_', and what is
    /// beyond 64 characters is cut off. A name that is taken gets a number: "outlet_2".
    [[nodiscard]] std::string add(std::string_view foreign);

    /// A remark that lists the changed names, for the report; empty if there are none.
    [[nodiscard]] std::string note() const;

private:
    std::set<std::string> taken_;
    std::vector<std::string> changed_;  // "'inlet 1' is now inlet_1"
};

}  // namespace vesselbench
