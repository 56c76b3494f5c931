#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

/// The kinds of input a case can begin with.
enum class InputKind { Surface, Image, Neighbour };

/// A part of prepare's report, which its page shows as a table of names and values.
struct ReportSection {
    std::string key;    ///< in report.json
    std::string title;  ///< heading on the page
    std::string about;  ///< a sentence below it
};

/// An operation's role in a recipe, for prepare and its report, which use it instead of names.
struct RecipePart {
    /// A recipe for such an input begins with it; its parameter `file` is the input. One operation
    /// of the table per kind.
    std::optional<InputKind> loads = std::nullopt;
    bool makes_source = false;       ///< makes the surface that results are compared with
    bool proves_source = false;      ///< if it fails, the input is bad, not the recipe
    bool cuts_ends = false;          ///< the source has no counterpart beyond the openings it makes
    bool makes_volume_mesh = false;  ///< its report has the mesh's `quality`
    /// What to try if it changes the volume noticeably: less of the first, or the second. Empty: it
    /// may change the volume.
    std::vector<Remedy> volume_remedies = {};
    /// Section of prepare's report that repeats its own report; none: listed among the steps only.
    std::optional<ReportSection> report_section = std::nullopt;
};

}  // namespace vesselbench
