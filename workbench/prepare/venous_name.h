#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vesselbench {

/// What a name says of its vessel.
struct VenousName {
    std::string word;     ///< of the name, in lower case
    bool portal = false;  ///< a portal vein, which distributes its blood
};

/// The word by which a label, a patch or a file is named like a vein: vein, vena, cava, portal,
/// azygos, jugular ..., in whatever case, alone or at the end of a longer word, with digits and
/// other characters between words. None in the name of a scan's phase ("portal venous phase") and
/// of an arterial sinus. \param name UTF-8 or not
[[nodiscard]] std::optional<VenousName> venous_name(std::string_view name);

}  // namespace vesselbench
