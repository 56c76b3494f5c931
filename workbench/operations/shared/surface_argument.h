#pragma once

#include "workbench/case/operation.h"

namespace vesselbench {

/// The parameter `units` of operations that read a surface file.
/// \param meaning Unit for the case's own surface
[[nodiscard]] Parameter units_parameter(Meaning meaning = Meaning::None);

/// A surface file read according to the arguments `file` and `units`.
struct SurfaceArgument {
    Surface surface;          ///< [mm]
    std::string name;         ///< the file's, without its folder
    std::string units;        ///< unit used: mm, cm or m
    std::string unit_reason;  ///< one sentence
    std::string unit_doubt;   ///< one sentence with both readings; empty: the unit is certain
    std::vector<std::string> notes;
};

/// Reads the file; the unit goes into the outcome's resolved arguments, doubts about a guessed one
/// into the warnings.
/// \throw UsageError for units=auto if two units are nearly as plausible; as read_surface
[[nodiscard]] SurfaceArgument read_surface_argument(const Arguments& arguments, Outcome& outcome);

}  // namespace vesselbench
