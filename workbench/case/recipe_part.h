#pragma once

#include <optional>
#include <string>

namespace vesselbench {

/// The kinds of input a case can begin with.
enum class InputKind { Surface, Image };

/// An operation's role in a recipe, for prepare and its report, which use it instead of names.
struct RecipePart {
    /// A recipe for such an input begins with it; its parameter `file` is the input. One operation
    /// of the table per kind.
    std::optional<InputKind> loads = std::nullopt;
    bool makes_source = false;       ///< makes the surface that results are compared with
    bool proves_source = false;      ///< if it fails, the input is bad, not the recipe
    bool cuts_ends = false;          ///< the source has no counterpart beyond the openings it makes
    bool makes_volume_mesh = false;  ///< its report has the mesh's `quality`
    /// What to try if it changes the volume noticeably: "fewer iterations keep it". Empty: it may
    /// change the volume.
    std::string volume_remedy = {};
    /// Key in prepare's report that repeats its own report; empty: listed among the steps only.
    std::string report_section = {};
};

}  // namespace vesselbench
