#include "workbench/operations/shared/crossing_warning.h"

#include "geometry/kernel/wording.h"

namespace vesselbench {

void warn_of_crossings(const TakenBack& taken, const std::string& mover, const std::string& remedy,
                       Outcome& outcome) {
    if (taken.vertices == 0) return;
    std::string text = counted(taken.vertices, "vertex", "vertices") + " moved less than the " +
                       mover + " would have moved them, first near " + place_text(taken.place) +
                       ": walls would have passed through each other";
    if (taken.crossings_left > 0)
        text += "; " + counted(taken.crossings_left, "pair of triangles", "pairs of triangles") +
                " still do: " + remedy;
    outcome.warnings.push_back(text);
}

}  // namespace vesselbench
