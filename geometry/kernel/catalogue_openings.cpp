#include "geometry/kernel/catalogue_openings.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
    // Openings.
    {"opening-in-bend",
     "the opening at {place} lies in a bend: the vessel turns by {turn_deg:%.0f} degrees over one "
     "diameter"},
    {"opening-shortens-branch",
     "the opening at {place} gives up {branch_percent:%.0f} % of its branch: the end is oblique or "
     "ragged"},
    {"opening-without-axis",
     "the vessel behind the opening at {place} is too short to measure its axis: the opening "
     "follows the centerline's direction"},
    {"opening-direction-uncertain",
     "the direction of the opening at {place} is only known to within {deviation_deg:%.0f} degrees "
     "(one standard deviation): its vessel is short, uneven or few voxels wide",
     kNote},
    {"opening-tilted",
     "the opening at {place} is tilted by {tilt_deg:%.0f} degrees against the vessel's axis"},
    {"too-few-openings",
     "a flow needs two openings, but there is {found}[. The ends found:{ends}][\n{fix} "
     "{advice}][\n{no_way}]"},
    {"flow-missing",
     "{end}, is {fate} ({why}): its flow would be missing[. The ends found:{ends}][\n{fix} "
     "{advice}][\n{no_way}]"},
    {"end-in-doubt",
     "it is not certain that {doubts}[. The ends found:{ends}][\n{fix} {advice}][\n{fix2} "
     "{else}][\n{no_way}]"},
    {"vessel-unstated",
     "{source} says '{word}', and --vessel does not say what it is\n{fix} takes it as "
     "{kind}\n{fix2} takes it as an artery, whose blood enters at the trunk"},
    {"vessel-taken",
     "{source} says '{word}': the vessel was taken as {kind}[; {fix} takes it as an artery]"},
    {"end-not-cut", "{why}\n{fix} leaves it closed on purpose"},
    {"end-decided", "{end} at {place}, {diameter_mm} mm wide, was {fate}: {why}"},
    {"small-ends-closed",
     "{ends#smaller end|smaller ends} stayed closed: see the report[; {fix} opens "
     "{opened:%.0f} of them]"},
    {"opening-gone",
     "the opening '{opening}' at {place} was left out: its vessel no longer exists"},
    {"inlet-gone",
     "the vessel of the inlet '{opening}' at {place} no longer exists: choose another "
     "inlet ({fix})"},
    {"flat-end-tilted",
     "a flat end was kept although tilted against the vessel's axis: {openings}; {fix} cuts it "
     "across"},
    {"flat-ends-tilted",
     "flat ends were kept although tilted against the vessel's axis: {openings}; {fix} cuts them "
     "across"},
    {"further-inlet",
     "{openings} faces the same way as the inlet: if blood flows in there as well, give {fix}"},
    {"further-inlets",
     "{openings} face the same way as the inlet: if blood flows in there as well, give {fix}"},
    {"portal-vein-inlet",
     "the blood of a portal vein is taken to enter at {inlets} and to leave at all other ends: "
     "where it gathers from several veins first, name each of their ends as an inlet"},
    {"cap-tilted",
     "the vessel's direction at '{opening}' is {tilt_deg:%.0f} degrees from the cap's normal: it "
     "is "
     "extruded along the normal"},
    {"cap-without-axis",
     "the vessel's direction at '{opening}' cannot be measured: it is extruded along the normal"},
    {"extrusion-shortened",
     "the extrusion of '{opening}' is {length_mm} mm instead of {wanted_mm} mm long: another part "
     "of the surface is in the way"},
    {"extrusion-as-before",
     "the extrusion of '{opening}' is {length_mm} mm instead of {wanted_mm} mm long, which was "
     "chosen when it was first made"},
    {"extrusion-limited",
     "the extrusion of {openings} is shorter than {diameters:%g} diameters, limited to {share:%g} "
     "of the model's extent; {fix} or {fix2} makes it longer"},
    {"no-openings", "the surface has no openings; make them first ({fix})"},
    {"opening-blocked",
     "the opening '{opening}' at {place} cannot be extruded: another part of the surface is in its "
     "way; clip it elsewhere, or leave it as it is"},
    {"opening-not-extruded",
     "the opening '{opening}' at {place} was not extruded: another part of the surface is in its "
     "way; clip it elsewhere if it has to be"},

    // Remeshing.
    {"radius-by-rays",
     "the radius was measured by rays across the lumen, because there are no centerlines: "
     "{reason}"},
    {"edges-limited",
     "edges of {edge_mm} mm, the finest that make no more than 1 million triangles; {fix} makes "
     "them finer or coarser"},
    {"edges-for-cells",
     "edges of {edge_mm} mm, {around:%.0f} around the typical vessel, so that about "
     "{millions:%.2g} million tetrahedra fill it: {fix} allows more of them, {fix2} sets the "
     "edges"},
    {"crossings-parted",
     "walls that almost touch near {place} crossed after remeshing and were separated there: the "
     "wall may have moved; separate the walls or use a smaller {fix} if that part matters"},
    {"beyond-resolution",
     "the surface is off by up to {off_mm} mm, in spite of shorter edges there ({place}); a "
     "smaller {fix} may bring it nearer"},
    {"opening-lost",
     "edges of {edge_mm} mm are too coarse for the opening {opening}, {diameter_mm} mm wide, which "
     "would be lost: use {fix} or less"},
    {"edges-coarse",
     "edges of {edge_mm} mm are coarse for this vessel: the volume changed by "
     "{volume_percent:%+.1f} %; use a smaller {fix}"},
    {"nothing-to-decimate", "nothing to do: the surface has at most {triangles#triangle}"},
    {"all-triangles-kept", "all triangles are kept: {why}"},
    {"no-triangle-free",
     "no triangle with a weight above 0 can be removed within the largest error allowed"},
    {"no-edge-collapses",
     "no edge can be collapsed within the largest error allowed; a larger {fix} permits more"},
    {"no-staircases", "there are no staircases: {why}"},
    {"fewer-would-fold",
     "{triangles#triangle is|triangles are} left instead of {wanted:%.0f}: fewer would fold the "
     "surface over, or lose a part of it"},
    {"fewer-would-cross",
     "{triangles#triangle is|triangles are} left instead of {wanted:%.0f}: fewer would make walls "
     "cross that almost touch ({locked#vertex|vertices} kept there), fold the surface over, or "
     "lose "
     "a part of it"},
    {"kept-vertices-lost",
     "{vertices#vertex|vertices} of weight 0 were removed or moved, to avoid degrading the rest; "
     "keep "
     "more triangles"},
    {"decimation-crosses-walls",
     "walls that almost touch near {place} cross in {crossings#place} now; keep more triangles, or "
     "separate the walls first"},
    {"weights-gain-nothing",
     "the weights gain nothing: the part they keep is {with_mm} mm off on average, and would be "
     "{without_mm} mm off without them, because the free part is too small to compensate for it; "
     "keep "
     "more "
     "triangles, or decimate without weights"},
};

}  // namespace

std::span<const CatalogueText> opening_texts() {
    return kTexts;
}

}  // namespace vesselbench
