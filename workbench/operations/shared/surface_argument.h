#pragma once

#include "workbench/case/operation.h"

namespace vesselbench {

/// The parameter `units` of operations that read a surface file.
/// \param meaning Unit for the case's own surface
[[nodiscard]] Parameter units_parameter(Meaning meaning = Meaning::None);

/// The parameter `space` of the same operations: the axes of the file's coordinates.
[[nodiscard]] Parameter space_parameter();

/// A surface file read according to the arguments `file`, `units` and `space`.
struct SurfaceArgument {
    Surface surface;          ///< [mm]
    std::string name;         ///< the file's, without its folder
    std::string units;        ///< unit used: mm, cm, m or um
    std::string unit_reason;  ///< one sentence
    std::string unit_doubt;   ///< one sentence with both readings; empty: the unit is certain
    bool turned = false;      ///< from RAS to LPS
    std::vector<std::string> notes;
};

/// Reads the file; unit and axes go into the outcome's resolved arguments, doubts about a guessed
/// one into the warnings.
/// \param operation that reads it
/// \throw UsageError for units=auto if two units are nearly as plausible; as read_surface
[[nodiscard]] SurfaceArgument read_surface_argument(const std::string& operation,
                                                    const Arguments& arguments, Outcome& outcome);

}  // namespace vesselbench
