#pragma once

#include <optional>
#include <string>

namespace vesselbench {

/// What a case can begin with.
enum class InputKind { Surface, Image };

/// What an operation is to those who walk a recipe (prepare and its report): they ask for this
/// instead of its name.
struct RecipePart {
    /// A recipe for such an input begins with it; the parameter `file` names the input. One
    /// operation of the table for each kind.
    std::optional<InputKind> loads = std::nullopt;
    bool makes_source = false;       ///< leaves the surface that results are compared with
    bool proves_source = false;      ///< where it fails, the input is bad, not the recipe
    bool cuts_ends = false;          ///< the source has no counterpart beyond the openings it makes
    bool makes_volume_mesh = false;  ///< its report has the mesh's `quality`
    /// What to try where it changes the volume noticeably: "fewer iterations keep it". Empty: it
    /// may change the volume.
    std::string volume_remedy = {};
    /// Key of prepare's report under which its own report is repeated; empty: among the steps only.
    std::string report_section = {};
};

}  // namespace vesselbench
