#pragma once

#include "workbench/case/operation.h"

namespace vesselbench {

/// The parameter `units` of operations that read a surface file.
[[nodiscard]] Parameter units_parameter();

/// A surface file as its operation's arguments `file` and `units` say.
struct SurfaceArgument {
    Surface surface;          ///< [mm]
    std::string name;         ///< the file's, without its folder
    std::string units;        ///< taken: mm, cm or m
    std::string unit_reason;  ///< one sentence
    std::vector<std::string> notes;
};

/// Reads the file; the unit goes into the outcome's resolved arguments, a doubt of it into its
/// warnings.
/// \throw as read_surface
[[nodiscard]] SurfaceArgument read_surface_argument(const Arguments& arguments, Outcome& outcome);

}  // namespace vesselbench
