#include "geometry/kernel/catalogue_refusals.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
    {"threshold-in-noise",
     "the surface meets the image's border at {places#place}: the threshold is within the noise; "
     "choose another {fix}"},
    {"no-closed-body", "no closed body found: choose another {fix}"},
    {"seed-in-no-body",
     "the seed, {place}, is in no body: the nearest one is {distance_mm} mm away; choose a {fix} "
     "inside the vessel"},
    {"no-voxel-inside",
     "no voxel is inside at threshold {threshold} (values from {least} to {most}): choose another "
     "{fix}"},
    {"every-voxel-inside",
     "every voxel is inside at threshold {threshold} (values from {least} to {most}): choose "
     "another {fix}"},
    {"parts-pass-through-each-other",
     "parts of the surface pass through each other near {place}; removing that would lose "
     "{area_percent:%.0f} % of the area: separate or unite these parts first, or rebuild the "
     "surface from its image"},
    {"still-not-manifold",
     "the surface is still not manifold near {place}: cut that place away with {fix} or {fix2}, or "
     "rebuild the surface from its image"},
    {"surface-one-sided",
     "the surface has no inner and outer side (like a Moebius strip): orientations contradict each "
     "other at {triangles#triangle}, one near {place}; cut the band there or export the surface "
     "again"},
    {"surface-not-connected",
     "the triangles form {pieces#unconnected piece}, the largest of which has only "
     "{area_percent:%.0f} % of the area: this is not a connected surface; export it again with "
     "shared points"},
    {"dab-without-surface",
     "no surface within {radius_mm} mm of {place} has a normal within 60 degrees of the dab's: the "
     "surface there has changed; brush again"},
    {"remeshing-too-fine",
     "remeshing would make more than {most_millions:%.0f} million triangles: use a larger {fix}"},
    {"too-many-features",
     "the surface bends by more than the feature angle around {regions#region}: use a larger {fix} "
     "or {fix2}"},
    {"too-many-subdivisions",
     "subdividing {triangles#triangle} {iterations#time} makes more than {most_millions:%.0f} "
     "million: use fewer {fix}"},
    {"operation-broke", "{what}; the project is unchanged: use other parameters[, or {fix} first]"},
    {"vertex-not-finite",
     "vertex {vertex:%.0f} has a coordinate that is not a finite number: export the surface again "
     "from its source"},
    {"vertex-too-far",
     "vertex {vertex:%.0f} lies more than 10 km from the origin: the file is damaged, or its unit "
     "another one; copy or export it again"},
    {"rim-crosses-itself",
     "the rim of an opening or a hole crosses itself, or two of its corners coincide: use {fix} "
     "first, or choose another place"},
    {"hole-not-manifold",
     "the hole at {place} cannot be closed: the surface is not manifold there; use {fix} first"},
    {"hole-cap-crosses", "the hole at {place} cannot be closed without crossing itself"},
    {"brush-on-degenerate",
     "the triangle at {place} has no area: use {fix} first, or brush beside it"},
    {"self-intersections-left",
     "{self_intersections#self-intersection} could not be removed, one near {place}: cut that "
     "place away with {fix} or {fix2}, or rebuild the surface from its image"},
    {"triangle-uses-vertex-twice", "a triangle uses a vertex twice near {place}: use {fix} first"},
    {"triangles-overlap",
     "triangles overlap or have inconsistent orientations near {place}: use {fix} first"},
    {"edge-not-manifold", "an edge has more than two triangles near {place}: use {fix} first"},
    {"borders-touch", "two open boundaries touch near {place}: use {fix} first"},
    {"vertex-not-manifold",
     "two parts of the surface touch at one vertex near {place}: use {fix} first"},
    {"too-large-for-local-levels",
     "the vessel fills a box of {million_voxels:%.0f} million voxels, more than "
     "{most_million_voxels:%.0f} million, which is too much for a local threshold: crop the image"},
    {"too-many-voxels",
     "resampling to voxels of {edge_mm} mm gives more than 2^30 voxels: use {fix} first, or "
     "larger voxels"},
    {"mask-outline-too-large", "the mask's outline has too many voxels: use {fix} first"},
    {"no-such-opening", "there is no opening '{opening}' (known: {known}): choose {fix}"},
    {"no-crop-region", "give either {fix}, or {fix2} and a radius"},
    {"neighbour-without-source", "give either {fix} or {fix2}"},
    {"voxel-size-unknown",
     "the {constraint} constraint needs the voxel size, which is unknown: give {fix}, x,y,z in mm, "
     "each above 0"},
    {"stack-axis-uncertain",
     "the direction of the image stack is uncertain: the surface has no image and too few "
     "staircases; give {fix}, three numbers x,y,z, or use {fix2}"},
    {"voxel-axes-unknown",
     "all axes of the voxels are asked for, but the surface has no image, and its triangles do not "
     "show them; give one axis with {fix}, three numbers x,y,z"},
    {"labels-without-image", "labels need a label map or a mask: use {fix} first"},
    {"no-neighbour", "distance awareness needs a neighbour, but there is none: use {fix} first"},
    {"no-such-neighbour",
     "there is no neighbour '{neighbour}': use {fix} first, or choose other {fix2}"},
    {"neighbour-without-triangles",
     "the neighbour '{neighbour}' has no triangles: load it again with {fix}, or use {fix2}"},
    {"no-volume-mesh", "there is no volume mesh in this variant: use {fix} first"},
    {"edge-out-of-proportion",
     "{name} = {edge_mm} mm is less than a millionth of the model; {fix} suits it"},
    {"extrusion-too-long",
     "an extrusion of '{opening}' by {length_mm} mm would make more than {most_millions:%g} "
     "million "
     "triangles: use {fix} or less"},
    {"mask-without-border", "the mask contains no voxel, or all of them: check it, or give {fix}"},
    {"mask-not-brighter",
     "inside the mask the image is not brighter than around it: give {fix}, or use {fix2}"},
    {"no-mask",
     "intensities inside a mask are asked for, but there is no mask: load the image with one "
     "({fix})"},
    {"no-end-to-close", "no vessel end is near {place}, where one is to stay closed"},
    {"no-end-near",
     "no vessel end is near {given}, where {meant} is to be; the nearest end is at {place}"},
    {"one-end-twice", "two inlets mean the same end, at {place}"},
    {"cap-not-flat", "the cap '{cap}' is not flat: clip it first with {fix}"},
    {"cap-not-a-disc",
     "the cap '{cap}' at {place} is not a single disc with one rim: vessels end there side by "
     "side, "
     "or something lies within; separate them in the segmentation, or crop the image so that it "
     "ends before they meet"},
    {"no-whole-section",
     "the branch with its tip at {place} has no whole section before its furcation or its other "
     "end: [remove it with {fix}][{advice}]"},
    {"end-cannot-be-cut",
     "the end at {place} cannot be cut: {why}; {fix} leaves it closed on purpose"},
    {"end-cannot-be-opened",
     "the {end} at {place} cannot be opened: {why}[\n{fix} leaves it closed on purpose][; "
     "{advice}]"},
    {"no-tip-near", "no branch has its tip near {given}; the nearest one is at {place}"},
    {"no-end-to-open", "no vessel end that could be opened was found: give one with {fix}"},
    {"branch-without-foot",
     "the branch with its tip at {place} does not protrude from its parent: there is nothing to "
     "remove"},
    {"branch-is-trunk",
     "the vessel with its tip at {place} is the trunk that the others leave: open it, or cut it "
     "there, with {fix}"},
    {"branch-too-wide",
     "the branch with its tip at {place} is as wide as its parent vessel: cut it there with {fix} "
     "instead"},
    {"branch-too-large",
     "the branch with its tip at {place} cannot be removed: {wall_percent:%.0f} % of the wall "
     "would be removed with it"},
    {"plane-misses-surface",
     "the clipping plane at {place} does not meet the surface: give the distance from the tip, or "
     "open the ends one by one ({fix})"},
    {"plane-meets-border",
     "the clipping plane at {place} meets an open border: clip farther away from the tip"},
    {"cut-without-rim", "the cut at {place} has no simple rim: use {fix} first, or clip elsewhere"},
    {"cut-takes-wall", "the cut at {place} would remove {wall_percent:%.0f} % of the wall"},
    {"cut-loses-vessel",
     "a cut there would lose {length_mm:%.1f} mm of vessel at {place}, {diameter_mm} mm wide"},
    {"cuts-take-model",
     "the cuts would remove {volume_percent:%.0f} % of the model: it is hardly a vessel; {fix}, "
     "the place of an end, opens a single one"},
    {"cap-not-flat-after-cuts", "the cap at {place} is not flat after the cuts"},
    {"opening-would-lie-in-wall", "the opening at {place} would lie in a vessel's side"},
    {"no-lumen",
     "the surface encloses no lumen: check its unit, or correct its orientation with {fix}"},
    {"surface-is-sheet",
     "there is no vessel in it: the surface is a sheet, {width_mm} mm wide and {thickness_mm} mm "
     "thick on average, and encloses no lumen"},
    {"larger-than-vessels",
     "the surface encloses {litres:%.3g} l, more than a heart with its great vessels: it is an "
     "organ "
     "or the body, and no vessel; {way}"},
    {"vessel-within-noise",
     "there is no vessel in it that can be distinguished from noise: the surface has "
     "{loops#loop}; choose another threshold ({fix}), or add a mask ({fix2})"},
    {"mask-within-noise",
     "there is no vessel in the mask that can be distinguished from noise: its surface has "
     "{loops#loop}, and no closing of up to 3 voxels mends it; segment the vessel anew, or fill "
     "the "
     "segment's holes in the program that made it"},
    {"surface-within-noise",
     "there is no vessel in it that can be distinguished from noise: the surface has "
     "{loops#loop}; make it anew from its image, with another threshold or a mask"},
    {"no-branch-at-tip", "no branch has its tip near {place}"},
    {"no-neck",
     "no plane separates a sac with its dome at {place} from the vessel's ends by one closed "
     "curve"},
    {"plane-is-no-neck",
     "the plane at {place} does not separate the sac with its dome at {dome} from the vessel's "
     "ends "
     "by one closed curve"},
    {"neck-without-direction", "the neck's plane has no direction: {fix} must not be 0,0,0"},
    {"neck-plane-incomplete",
     "the neck's plane needs a place and a direction: give both {fix} and {fix2}, or neither"},
    {"no-sac-found",
     "no blind end is likely to be a sac: give {fix}, a point in its dome[; {ends}]"},
    {"several-sacs",
     "{sacs#blind end is|blind ends are} likely to be sacs: give {fix}, a point in the dome of "
     "one; "
     "{ends}"},
    {"neck-in-doubt",
     "the plane at {place} hardly is a sac's neck, since {why}: the sac's figures are left out; "
     "give another plane ({fix}), or {fix2} for the figures of this one"},
    {"sac-not-measured", "the marked sac is not measured on this model: {reason}"},
    {"branch-without-parent",
     "the vessel with its tip at {place} has no parent vessel: nothing would remain"},
    {"no-closed-section",
     "the branch with its tip at {place} has no closed section: give {fix} from its tip"},
    {"distance-beyond-branch",
     "the branch with its tip at {place} is only {length_mm} mm long: use a smaller {fix}"},
    {"no-section-at-distance",
     "the branch with its tip at {place} has no closed section {distance_mm} mm from its tip: "
     "choose another {fix}"},
    {"wall-torn",
     "the surface is no vessel's wall: its {triangles#triangle} would have {lines#line}; the file "
     "is damaged: copy or export it again"},
    {"no-centerline",
     "no centerline found: the lumen is thinner than the search grid, or not closed; use {fix} "
     "first, or {fix2} to keep the vessels of interest only"},
    {"cut-in-loop",
     "the cut at {place} does not separate the branch from the rest: the vessels form a loop "
     "there; clip one of the other branches as well, or choose another place"},
    {"edges-too-fine",
     "edges of {edge_mm} mm would make about {millions} million triangles, more than "
     "{most_millions:%.0f} million; use {fix} or more"},
    {"crosses-itself", "the surface intersects itself near {place}; use {fix} first"},
    {"would-cross-itself",
     "the new triangles would intersect themselves near {place}, where walls touch[: {fix} may "
     "help][; {advice}]"},
    {"edges-too-coarse",
     "edges of {edge_mm} mm are too coarse for this vessel: the volume would change from "
     "{before_mm3:%.4g} to {after_mm3:%.4g} mm^3; use {fix}"},
    {"surface-not-manifold", "the surface is not manifold; use {fix} first"},
    {"print-not-a-solid", "3MF: the surface is not {property}; use {fix} first"},
    {"print-has-holes",
     "3MF: a print needs a closed surface, but this one has {holes#hole}, the first near {place}; "
     "{fix} caps a vessel end, {fix2} closes a hole"},
    {"no-inlet-and-outlet",
     "flow conditions: the model has {inlets#inlet} and {outlets#outlet}, but needs one of each: "
     "cut the vessel's ends with {fix}"},
    {"improved-mesh-invalid", "the improved mesh is not valid ({reason}); use {fix}"},
    {"not-filled",
     "TetGen cannot fill the surface; tried:{attempts}\nuse {fix} and {fix2} first, with a smaller "
     "edge length where walls are close"},
    {"no-surface", "there is no surface: use {fix} first, or {fix2} and extract it"},
    {"no-image", "there is no image: use {fix} first"},
    {"nothing-to-crop", "nothing to crop: use {fix} or {fix2} first"},
    {"no-opening-at-inlet",
     "no opening is near the inlet given, {given}; the nearest one, {nearest}, is at {place}: open "
     "the inlet's own end first ({fix})"},
    {"no-tube",
     "there is no vessel in it: nothing of the closed surface is 1.5 times as long as it is wide; "
     "{fix}, the place of an end, opens it nevertheless"},
};

}  // namespace

std::span<const CatalogueText> refusal_texts() {
    return kTexts;
}

}  // namespace vesselbench
