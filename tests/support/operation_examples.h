#pragma once

#include <map>
#include <string>

#include "geometry/kernel/vec3.h"
#include "workbench/case/operation.h"

namespace vesselbench::test {

/// The vessel and the files with which operations are tried.
struct ExampleGround {
    double radius = 1.0;         ///< of the vessel [mm]
    Vec3 wall = Vec3::Zero();    ///< on it
    Vec3 end = Vec3::Zero();     ///< at one of its ends
    Vec3 branch = Vec3::Zero();  ///< at the tip of a branch that can go
    std::map<InputKind, std::string> files = {};
    std::string mask = {};  ///< of the image; empty: none
};

/// The operation's example on this ground.
[[nodiscard]] Arguments example_arguments(const Operation& operation, const ExampleGround& ground);

/// What its next revision sets.
[[nodiscard]] Arguments example_changes(const Operation& operation, const ExampleGround& ground);

}  // namespace vesselbench::test
