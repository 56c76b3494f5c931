#pragma once

#include <string>
#include <vector>

#include "workbench/case/arguments.h"

namespace vesselbench {

/// What an operation needs to find in a scene.
enum class ExampleScene {
    Tube,      ///< a closed vessel without branches
    Holes,     ///< a wall with holes
    Branches,  ///< a closed vessel with branches
    Openings,  ///< a vessel whose ends are opened
    Image,     ///< an image and no surface
    Contact    ///< two vessels that are blended where they touch
};

/// A short run of an operation and its next revision, for what goes through the whole table: tests
/// and benches. Their scenes differ, so lengths (parameters in mm) are in radii of the vessel at
/// hand; it also has the places, files and names that required parameters take.
struct OperationExample {
    ExampleScene scene = ExampleScene::Tube;
    std::vector<std::string> placed = {};  ///< optional parameters that take a place too
    Arguments given = {};                  ///< beside places, files and names
    Arguments changed = {};                ///< set in the next revision; never empty
};

}  // namespace vesselbench
