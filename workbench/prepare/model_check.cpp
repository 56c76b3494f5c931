#include "workbench/prepare/model_check.h"

#include <memory>
#include <string>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"

namespace vesselbench {

namespace {

/// Empty for a surface without vessels, such as a heart's.
std::shared_ptr<const CenterlineGraph> lines_of(const Surface& surface, const Progress& progress) {
    try {
        return centerlines_of(surface, {}, progress);
    } catch (const AlgorithmFailure&) {
        return nullptr;
    }
}

}  // namespace

void check_vessels(const Surface& before, const Surface& after, const Progress& progress) {
    const auto lines = lines_of(before, progress);
    if (!lines) return;
    const auto lost = lost_vessels(*lines, after);
    if (lost.empty()) return;
    std::string text;
    for (const LostVessel& vessel : lost)
        text += "\n  " + formatted(vessel.length, "%.1f") + " mm at " + place_text(vessel.place) +
                ", diameter " + formatted(vessel.diameter) + " mm";
    throw AlgorithmFailure("the model has lost vessels:" + text +
                           "\nopen their ends by hand with clip-opening tip=x,y,z distance=..., or "
                           "remesh finer; a branch that is not wanted is taken away with "
                           "remove-branch before clip-opening");
}

void check_openings(const Surface& before, const Surface& after) {
    for (const std::size_t p : openings_in_walls(before, after))
        throw AlgorithmFailure(
            "the opening '" + after.patches[p].name + "' at " +
            place_text(patch_shape(after, p).plane.point) +
            " lies in a vessel's side: leave that end closed with --set clip-opening.closed=" +
            coordinates_argument(patch_shape(after, p).plane.point));
}

}  // namespace vesselbench
