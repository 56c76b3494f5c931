#include "geometry/kernel/catalogue.h"

#include "geometry/kernel/diagnostic.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
    {kPlainText, "{text}"},

    // Files and images.
    {"unit-guessed",
     "{file} does not state its unit: {doubt}; both can be a vessel. It is read as {units}; if "
     "that "
     "is wrong, give {fix}"},
    {"unit-unlikely",
     "{file} is read in {units}, as asked, but has a vessel's size in {likely} only ({reason})"},
    {"voxels-too-small",
     "the file states no unit and its voxels measure {spacing}: taken as metres; if that is wrong, "
     "give {fix}"},
    {"unit-in-doubt", "{doubt}: give {options} (of an edit: units=)"},
    {"mask-not-labels", "mask: {reason}"},
    {"mask-of-intensities",
     "the mask holds neither labels nor a level set: give {fix}, the value that bounds its inside"},
    {"mask-resampled",
     "the mask has a grid of its own, {mask}: it was resampled by shape to that of the image, "
     "{image}; 3D Slicer exports it on the image's grid (Segmentations, Export to files, with the "
     "image as reference volume)"},
    {"mask-beyond-image",
     "{lost_percent:%.3g} % of the mask lies beyond the image and is left out"},
    {"label-unchosen",
     "there are {labels#label}, and which is the vessel is not chosen:{list}\nchoose it with "
     "{option}, by name or label; --label {several} takes two as one vessel, --label all takes all "
     "of them"},
    {"file-note", "{note}"},
    {"file-not-read", "{reason}[; {advice}]"},
    {"file-without-triangles",
     "{file} contains no triangles[, {content}]: export it again as a surface"},

    // Extraction.
    {"all-labels-taken",
     "all labels were taken as one structure, {labels}; to take some of them, give {fix}"},
    {"one-threshold",
     "one threshold makes the surface, since {reason}: thin vessels may come out too thick or too "
     "thin"},
    {"volume-uncertain",
     "the vessel's volume is uncertain by about {volume_percent:%.0f} %: beside the image's blur "
     "({blur} mm) it is so thin that its core reaches {core_percent:%.0f} % of the contrast"},
    {"radius-undetermined",
     "{wall_percent:%.0f} % of the wall belongs to vessels no wider than the image's blur ({blur} "
     "mm): their radius is not determined"},
    {"vessel-dropped",
     "of {bodies#body|bodies}, one dropped at {place} is {length_mm} mm long and {diameter_mm} mm "
     "wide: perhaps a vessel that is broken off; {fix} bridges a gap of two voxels, and {fix2} "
     "keeps all"},
    {"body-dropped",
     "there are {bodies#body|bodies}; the largest one dropped has {dropped_mm3:%g} mm^3 (kept: "
     "{kept_mm3:%g}): choose another one with {fix}, or keep all with {fix2}"},
    {"wall-touches-border",
     "the mask's wall touches the image's border at {places#place}, where no vessel ends, as where "
     "a segment was cropped to its own box: it is closed smoothly there; {fix} closes it flat"},
    {"missing-voxels-filled",
     "the mask was full of holes ({loops#loop} and cavities): they were closed, which added "
     "{voxels_percent:%.1f} % of its voxels; {fix} says how far it is closed, and {fix2} leaves it "
     "as it is"},
    {"voxels-joined",
     "{voxels#voxel was|voxels were} added where a vessel's voxels touch at edges or corners only; "
     "{fix} leaves it apart there"},
    {"width-below-voxels",
     "a vessel is a single voxel wide at {voxels#voxel}, as near {place}: it is there, but the "
     "mask "
     "does not say how wide it is below two voxels ({width_mm} mm); there it was made about one "
     "wide"},
    {"cleaning-changed-topology", "cleaning changed the topology: {before} became {after}"},
    {"vessel-leaves-image",
     "the vessel leaves the image at {places#place}; it is closed by flat caps there (patches "
     "cut_1 ...)"},
    {"not-a-label-map",
     "the image contains {value} and is not a label map: for intensities, use {fix}"},
    {"threshold-changes-volume",
     "at one threshold, {threshold}, the vessel's volume is about {volume_percent:%.0f} % {larger} "
     "than what its intensities add up to: {fix} follows them"},
    {"handle-artefact",
     "the lumen has a handle at {place}, {width_mm} mm wide and {length_mm} mm around: so small a "
     "ring is an artefact; cleaning, or another threshold, removes it[, and {fix} parts vessels "
     "that touch]"},
    {"handle",
     "the lumen has a handle at {place}, {width_mm} mm wide and {length_mm} mm around: if two "
     "vessels merely touch there, blood takes a path that does not exist[, and {fix} parts them]; "
     "a true ring of vessels, such as the circle of Willis, stays"},
    {"many-handles",
     "the lumen has {handles#handle}: vessels touch, or noise is part of it; choose another "
     "threshold, or clean the image[; {fix} leaves {left:%.0f} of them]"},
    {"pillar-in-lumen",
     "something passes through the lumen at {place}, where the ring around it is {width_mm} mm "
     "wide "
     "and {length_mm} mm long: voxels of a calcification or a void that the mask leaves out, or a "
     "gap between vessels; {fix} fills it"},

    // Repair and local edits.
    {"outer-wall-removed",
     "the surface has the outer and the inner side of a vessel's wall: the outer one was removed, "
     "since blood flows inside the inner one[; {fix} keeps the outer one instead]"},
    {"wall-has-two-sides",
     "the surface has the outer and the inner side of a vessel's wall, one within the other: "
     "{fix} keeps the inner one, the lumen in which blood flows; {fix2} keeps the outer one"},
    {"bodies-united",
     "{bodies#closed body|closed bodies} that overlap were united; {fix} keeps the largest one "
     "only"},
    {"bodies-left-out",
     "{bodies#body was|bodies were} left out that cannot be a vessel, the largest at {place}; "
     "{fix} "
     "takes whatever overlaps as part of the model"},
    {"body-no-vessel",
     "a body of the surface cannot be a vessel: the one at {place}, {x_mm} x {y_mm} x {z_mm} mm; "
     "{fix} leaves it out, {fix2} takes it as part of the model where it overlaps"},
    {"orientation-contradicts",
     "the orientation of the triangles keeps contradicting itself: export the surface again, or "
     "rebuild it from its image"},
    {"no-triangle-left",
     "all triangles are degenerate: there is no surface; export it again in more digits, or as a "
     "surface instead of lines"},
    {"bodies-not-united",
     "closed bodies of the surface overlap near {place}, but cannot be united: unite them in the "
     "program that made them, or rebuild the surface from its image"},
    {"vessel-removed",
     "{pieces#unconnected piece was|unconnected pieces were} removed, the longest of which, at "
     "{place}, is {length_mm} mm long and {diameter_mm} mm wide: a vessel; {fix} keeps it"},
    {"pieces-removed",
     "{pieces#unconnected piece|unconnected pieces} with {triangles#triangle} were removed; to "
     "keep "
     "more of them, give {fix}"},
    {"hole-in-wall-closed",
     "a hole at {place} was closed, {width_mm} mm wide, in the wall of a vessel {lumen_mm} mm "
     "wide, "
     "where a branch may have been torn off; {fix} leaves it open"},
    {"vessel-end-closed",
     "a hole at {place} was closed, {width_mm} mm wide, as wide as the vessel behind it; {fix} "
     "leaves it open"},
    {"more-holes-closed",
     "{holes#smaller hole was|smaller holes were} closed that may be ends of vessels: see the "
     "report"},
    {"orientation-reversed", "the surface was inside out; its orientation was reversed"},
    {"width-unknown", "the surface's image is unknown, and so is what is too narrow: give {fix}"},
    {"lumen-widened",
     "the lumen was narrower than {limit_mm} mm at {places#place} and was widened, at {place} from "
     "{width_mm} mm: check whether vessels are joined there at all"},
    {"still-narrow",
     "the lumen is still narrow at {places#place}, {width_mm} mm at {place}: inflate it by hand "
     "({fix}), or cut it off"},
    {"no-narrowing-there",
     "the vessel is not narrower at {place} than beside it[: the nearest narrowing is that of "
     "{fix}]; give from and to to widen any stretch"},
    {"narrowing-off-vessel",
     "the place {place} is {distance_mm} mm away from the nearest vessel's axis: give one on its "
     "wall or inside"},
    {"narrowing-at-branch-end",
     "the place {place} is at a furcation or at the end of a vessel: there is nothing to compare "
     "its radius with; brush-inflate widens by hand"},
    {"narrowing-without-vessel",
     "the stretch at {place} leaves too little of its vessel to compare it with, or has no length"},
    {"narrowing-at-opening",
     "the narrowing at {place} ends at an opening or a cap, which must not move: widen it before "
     "the vessel is opened, or choose a shorter stretch"},
    {"narrowing-not-a-tube",
     "the wall around the narrowing at {place} is no tube: another vessel or a sac is joined to it "
     "there"},
    {"narrowing-nearly-closed",
     "the vessel is nearly closed at {place}: of a radius of {found_mm} mm there is no section "
     "that "
     "could be widened to {expected_mm} mm; give a smaller {fix}, or rebuild the vessel"},
    {"narrowing-without-room",
     "the vessel cannot be widened: another wall is {gap_mm} mm away at {place}; a smaller radius "
     "or strength leaves room"},
    {"narrowing-would-cross",
     "the widened wall would pass through itself at {place}: smooth it first, or choose a smaller "
     "radius or a longer stretch"},
    {"narrowing-radius-small",
     "a radius of {radius_mm} mm does not widen the vessel, whose radius is {found_mm} mm at "
     "{place}: give a larger {fix}"},
    {"image-shows-narrowing",
     "the image agrees with the narrowing at {place}: the lumen is as bright as beside it "
     "({core_percent:%.0f} %) and has a radius of {lumen_mm} mm, not {expected_mm} mm; it may be a "
     "stenosis"},
    {"image-undecided-on-narrowing",
     "the image does not show whether the vessel is narrow at {place}: its core has "
     "{core_percent:%.0f} % of the contrast beside it"},
    {"dabs-without-effect",
     "{dabs#dab} changed nothing: the strength is 0, the radius is smaller than the triangles, or "
     "the place is on a cap"},
    {"dab-off-surface",
     "the place {given} is {distance_mm:%.4g} mm away from the surface; brushed at the nearest "
     "point, {place}"},
    {"dab-too-far",
     "the place {given} is {distance_mm:%.4g} mm away from the surface, more than {radii:%.0f} "
     "radii: give a point on it, as the nearest one, {place}"},
    {"brush-coarse",
     "the triangles near {place} have edges of {edge_mm} mm, too coarse for a brush with a radius "
     "of {radius_mm} mm: {fix} refines them there"},
    {"no-contact",
     "the lumen has no waist near {place}: no two vessels touch there; give the tool's {fix}, or a "
     "place on the wall of the contact"},
    {"stamp-touches-nothing",
     "the tool at {place} does not cut the vessel's wall: it lies beside it, or inside the lumen; "
     "give another {fix}"},
    {"stamp-swallows",
     "the tool at {place} contains the wall around it[, and would change {volume_percent:%.0f} % "
     "of "
     "the vessel's volume]: make it smaller, or give another {fix}"},
    {"stamp-cuts-opening",
     "the tool at {place} cuts the cap of {opening}: give another {fix}, or make the tool smaller"},
    {"stamp-too-thin",
     "the tool at {place} is {thickness_mm} mm thick, thinner than the triangles allow (edges of "
     "{edge_mm} mm): refine them with {fix}"},
    {"stamp-degenerate",
     "the tool at {place} meets the wall in a way that cannot be resolved: it only touches it, or "
     "the wall crosses itself there; give another {fix}"},
    {"stamp-crosses",
     "the stamped wall would pass through another wall near {place}: use a smaller {fix}, or "
     "{fix2} "
     "first if the surface crosses itself"},
    {"no-contact-found",
     "the surface has no handle by which a contact could be found: give a place where two vessels "
     "touch as {fix}"},
    {"contact-without-arms",
     "two vessels that touch leave their contact by four arms; near {place} {arms#arm leaves|arms "
     "leave} the surroundings: there is one vessel only, or a tip or a furcation is too near. Give "
     "another {fix}, or use {fix2}"},
    {"contact-one-arm",
     "both places of the vessel are at its same side of the contact, near {place}: give {fix} and "
     "{fix2} on both sides"},
    {"contact-joins",
     "the vessels at {place} do not touch, they join: no two tubes pass each other there; give "
     "another {fix}"},
    {"contact-pairing-unclear",
     "which arms belong together at {place} cannot be told: one pairing leaves "
     "{misfit_percent:%.0f} "
     "% of the walls unexplained, another one {other_percent:%.0f} %; name two places of one "
     "vessel "
     "by {fix} and {fix2}"},
    {"contact-not-parted",
     "the walls at {place} cannot be told apart, or closed: the contact reaches too far along the "
     "vessels; give another {fix}, or use {fix2}"},
    {"separate-gap",
     "a gap of {gap_mm} mm cannot be had near {place}: the vessels would lose more than half of "
     "their radius, or are nearer beside the contact[; {reached_mm} mm can be had: {fix}]"},
    {"separate-crosses",
     "the separated wall would pass through another wall near {place}: use {fix} first if the "
     "surface crosses itself"},
    {"brush-crosses-walls",
     "{vertices#vertex|vertices} moved less than the brush would have moved them, first near "
     "{place}: walls would have passed through each other[; {crossings#pair of triangles still "
     "does|pairs of triangles still do}: undo, and brush with less {fix}]"},
    {"widening-crosses-walls",
     "{vertices#vertex|vertices} moved less than the widening would have moved them, first near "
     "{place}: walls would have passed through each other[; {crossings#pair of triangles still "
     "does|pairs of triangles still do}: separate the walls, or use {fix}]"},

    // Posing of branches.
    {"nothing-to-deform", "nothing is to be done: give {fix}, or {fix2}"},
    {"branches-apart", "no gap between branches is smaller than {gap_mm} mm: nothing was moved"},
    {"branches-parted",
     "the smallest gap between branches, {before_mm:%.2f} mm at {place}, was widened to at "
     "least {gap_mm:%.2f} mm; a wall was moved by up to {shift_mm:%.2f} mm: the model is for "
     "printing "
     "only"},
    {"no-branch-here", "no vessel's centerline is near {place}"},
    {"place-is-rigid",
     "at {place} the vessel does not bend, since a furcation or the inlet is near: choose a place "
     "farther along the branch"},
    {"branch-too-short-to-bend",
     "the branch at {place}, {length_mm} mm long, is too short to be bent between its ends"},
    {"branch-in-loop",
     "the branch at {place} is part of a loop of vessels: it cannot be moved on its own"},
    {"move-not-reached",
     "the branch cannot follow to {place}: it is held {missing_mm:%.3g} mm before, since vessels "
     "keep their length; move it less, or use a larger {fix}"},
    {"bend-too-strong",
     "the vessel would be bent to a radius of {bend_mm:%.3g} mm at {place}, less than {radii} of "
     "its own radii ({least_mm:%.3g} mm): move it less, or use a larger {fix}"},
    {"posing-crosses-walls",
     "walls would pass through each other near {place}: move the branch less, or elsewhere"},
    {"gap-not-reached",
     "the gap at {place} cannot be made {gap_mm} mm wide: the branches can be pushed apart to "
     "{reached_mm:%.3g} mm there; use a smaller {fix}, or move a branch by hand with {fix2}"},

    // Smoothing.
    {"filter-crosses-walls",
     "{vertices#vertex|vertices} moved less than the filter would have moved them, first near "
     "{place}: walls would have passed through each other[; {crossings#pair of triangles still "
     "does|pairs of triangles still do}: use fewer {fix}, or {fix2}]"},
    {"filter-roughens",
     "Laplace+HC with these values roughens the surface instead of smoothing it: keep (1 - beta) * "
     "lambda at or below 0.5"},
    {"filter-amplifies",
     "Taubin with these values amplifies the finest bumps: use a smaller lambda ({fix} is safe)"},
    {"gpu-not-used", "the GPU was asked for, but the CPU computed this, because {reason}"},
    {"weights-hold-back",
     "the weights leave almost nothing to smooth (mean {weight:%g}):[ staircase "
     "{staircase_weight:%g}][ distance {distance_weight:%g}][ painted {painted_weight:%g}]"},
    {"hardly-any-staircases",
     "hardly any staircases: {found:%.0f} of {vertices#vertex|vertices} bend across the slices by "
     "more than {tau_theta:%g}, so the surface gets {beta_min:%g} of the smoothing; a smaller "
     "value "
     "of {fix} finds gentler staircases, {fix2} smooths in full"},
    {"no-vertex-on-staircases",
     "the surface bends nowhere by more than {tau_theta:%g}; a smaller value of {fix} finds "
     "gentler "
     "staircases[; {fix2} lets the rest move]"},
    {"all-within-margin",
     "the whole surface is within the margin of {margin_mm:%g} mm; its farthest vertex is "
     "{farthest_mm:%g} mm from a neighbour"},
    {"nothing-moved", "nothing moved: {why}"},
    {"all-kept", "every vertex is kept or has weight 0"},

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
     "(one standard deviation): its vessel is short, uneven or few voxels wide"},
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

    // What an operation refuses.
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

    // Findings.
    {"finding-without-treatment",
     "no operation treats {finding} by itself: brush there, or choose another threshold"},
    {"found-self-intersection",
     "{pairs#pair of triangles intersects|pairs of triangles intersect} within {size_mm} mm: the "
     "wall passes through itself"},
    {"found-detached",
     "a piece of {triangles#triangle}, {length_mm} mm long and {diameter_mm} mm wide, has "
     "{area_percent:%.2g} % of the area and is not connected to the rest"},
    {"found-hole",
     "the wall has a hole with {edges#edge}, {width_mm} mm wide[, where the lumen is {lumen_mm} mm "
     "wide]: no vessel ends there"},
    {"found-contact",
     "two walls are {distance_mm} mm apart, where less than {limit_mm} mm cannot be told from "
     "vessels that are joined; on the model they are apart, so that nothing is left to be "
     "separated: see in the image whether they are one vessel"},
    {"found-thread",
     "the lumen is {width_mm} mm wide, less than half a voxel ({limit_mm} mm): the image hardly "
     "shows it"},
    {"found-narrowing",
     "the vessel is narrower than beside it: over {length_mm} mm, its radius is down to {found_mm} "
     "mm "
     "where {expected_mm} mm is expected[; {image}]"},
    {"found-staircases",
     "{share_percent:%.0f} % of the wall's vertices lie on steps across the image's slices: it "
     "bends there by more than {tau_theta:%.2g}, at most by {sharpest:%.2g}, where 1 is a right "
     "angle"},
    {"found-bump",
     "the wall rises {height_mm} mm above the smooth tube around it, over a spot {width_mm} mm "
     "wide; the vessel's radius is {radius_mm} mm, and the wall around scatters by {scatter_mm} "
     "mm"},
    {"found-dent",
     "the wall lies {height_mm} mm below the smooth tube around it, over a spot {width_mm} mm "
     "wide; the vessel's radius is {radius_mm} mm, and the wall around scatters by {scatter_mm} "
     "mm"},
    {"found-stub",
     "a blind branch is {length_mm} mm long beyond the vessel it leaves, {diameter_mm} mm wide "
     "(its parent {parent_mm} mm)"},
    {"reading-necked", "its body is {ratio:%.2g} times as wide as its neck"},
    {"reading-wide", "it is {percent:%.0f} % as wide as the vessel it leaves"},
    {"reading-flow-without", "the vessels at its root are in balance without it"},
    {"reading-long", "it is {ratio:%.2g} times as long as it is wide"},
    {"reading-even", "it keeps its width: its outer third has {percent:%.0f} % of its inner one's"},
    {"reading-onwards", "it goes on in a vessel's direction, {angle_deg:%.0f} degrees off"},
    {"reading-flow-missing", "the vessels at its root are out of balance without it"},
    {"reading-short", "it reaches out by {percent:%.0f} % of its width only"},
    {"reading-tapers", "it tapers: its outer third has {percent:%.0f} % of its inner one's width"},
    {"reading-thin", "it is only {across:%.1f} voxels or edges wide"},
    {"reading-no-bridge", "no vessel lies between them: {ratio:%.1f} widths"},
    {"reading-bridge", "a vessel of {ratio:%.1f} widths lies between them"},
    {"reading-image-agrees",
     "the image shows the same: a lumen {lumen_mm} mm wide with {contrast_percent:%.0f} % of the "
     "contrast beside it"},
    {"reading-contrast-falls",
     "the image shows a lumen {lumen_mm} mm wide with {contrast_percent:%.0f} % of the contrast "
     "beside it"},
    {"reading-at-furcation", "it is {distance_mm} mm from a furcation, where plaques arise"},
    {"reading-gradual", "the vessel narrows gradually, over {length_mm} mm"},
    {"reading-shallow", "its depth is {voxels:%.1f} voxels only"},
    {"found-oblique-end",
     "a flat end, {diameter_mm} mm wide, is tilted by {tilt_deg:%.0f} degrees against the vessel's "
     "axis, which is known to within {doubt_deg:%.1f} degrees"},
    {"found-frayed-end",
     "a vessel {trunk_mm} mm wide ends in {threads#thread} of at most {diameter_mm} mm: its "
     "contrast fades there"},

    // Products.
    {"cells-limited",
     "{wanted:%.0f} cells requested, {reached:%.0f} reached: the surface's edge length limits the "
     "number; to change it, use {fix}"},
    {"lumen-finer-than-wall",
     "the lumen's edges are {size:%.2g} of the surface's: to resolve the wall as well with "
     "{wanted:%.0f} cells, use {fix} with an edge length scaled by about that factor"},
    {"surface-divided",
     "TetGen had to divide triangles of the surface: the volume mesh's boundary is finer than the "
     "surface"},
    {"layers-between-openings",
     "layers cannot end where {one} and {other} meet, at {place}: cut them farther apart, or use "
     "{fix}"},
    {"layers-opening-not-flat",
     "layers end in the planes of openings, but {opening} is not flat, by {off:%.2g} mm: cut it "
     "with "
     "{fix}, or use {fix2}"},
    {"layers-at-fold",
     "no layer can grow where the wall is folded, at {place}: from {count#vertex|vertices} no "
     "direction into the lumen sees all triangles of the wall; smooth the wall there, or use "
     "{fix}"},
    {"layers-too-thin",
     "no valid layer is found at {place}, however thin: smooth the wall there, or use {fix}"},
    {"layers-exceed-cells",
     "{layers#layer|layers} on this wall are {prisms:%.0f} prisms, too many of {wanted:%.0f} "
     "cells: "
     "fewer layers, more cells, or longer edges by {fix}"},
    {"layers-beyond-lumen",
     "layers of {wished:%.3g} mm have no room in the lumen, where {thickness:%.2g} mm is the most "
     "on "
     "half of the wall; ask for less, or use {fix}"},
    {"layers-not-filled",
     "the lumen inside the layers cannot be filled ({reason}); thinner layers may help, or use "
     "{fix}"},
    {"layers-invalid", "the mesh with layers is not valid ({reason}); use {fix}"},
    {"layers-limited",
     "the wall's layers are thinner than half of {wished:%.3g} mm on {percent:%.1f} % of the "
     "wall, the thinnest {thinnest:%.2g} mm at {place}: walls are close or curved there"},
    {"surface-not-fillable", "the surface cannot be filled with tetrahedra:{obstacles}"},
    {"surface-not-finite",
     "{count#coordinate is not a finite number|coordinates are not finite numbers}: the file is "
     "damaged; export it again "
     "from its source"},
    {"surface-duplicate", "{count#triangle occurs|triangles occur} twice, at {places}; use {fix}"},
    {"surface-degenerate", "{count#triangle has|triangles have} no area, at {places}; use {fix}"},
    {"surface-sliver",
     "{count#triangle is a sliver|triangles are slivers} (height below 1 % of the longest edge), "
     "at "
     "{places}; "
     "use {fix}"},
    {"surface-gap",
     "{count#gap|gaps} in the surface (edges with one triangle), at {places}: close them; "
     "{fix} makes caps, {fix2} closes holes"},
    {"surface-edge-not-manifold",
     "{count#edge is|edges are} shared by more than two triangles, at {places}; use {fix}"},
    {"surface-vertex-not-manifold",
     "parts of the surface touch at {count#single vertex|single vertices}, at {places}; use {fix}"},
    {"surface-orientation",
     "{count#pair|pairs} of adjacent triangles with opposite orientations, at {places}; use {fix}"},
    {"surface-in-parts", "the surface consists of several separate parts, at {places}; use {fix}"},
    {"surface-inside-out", "the triangles face inward, at {places}; use {fix}"},
    {"surface-crosses-itself",
     "{count#pair of triangles intersects|pairs of triangles intersect}, at {places}; use {fix}; "
     "if "
     "two branches touch, "
     "extract them separately (a mask, another threshold)"},
    {"thin-place",
     "the thinnest place of the model is {distance_mm} mm, below {limit_mm} mm, at {place}"},
    {"narrow-gap",
     "the smallest gap between two branches is {distance_mm} mm, below {limit_mm} mm, at {place}"},
    {"cast-may-break",
     "the vessel turns by {turn_deg:%.0f} degrees within two diameters at {place}, above "
     "{limit_deg:%.0f}: a cast may break there when it is taken out of its mold; straighten the "
     "branch, or do not cast it"},
    {"flow-not-laminar",
     "{inlet}: Reynolds number {reynolds:%.0f} is above 2000; the laminar case does not describe "
     "this flow"},
    {"inlet-in-bend",
     "{inlet} is in a bend (the centerline turns by {turn_deg:%.0f} degrees within two diameters): "
     "the inflow profile is not that of a straight vessel; clip elsewhere or extrude the opening"},

    // Edits and recipes.
    {"argument-without-effect", "{argument} has no effect without {condition}"},
    {"effect-on-volume-differs",
     "it changes the volume by {now_percent:%+.2f} %, but by {before_percent:%+.2f} % before an "
     "earlier "
     "edit was changed: check that it still does what it was made for"},
    {"effect-on-surface-differs",
     "it changes the surface by up to {now_mm:%.3f} mm, but by up to {before_mm:%.3f} mm before an "
     "earlier edit was changed: check that it still does what it was made for"},
    {"volume-changed",
     "the volume changed by {volume_percent:%.1f} %: fewer {fix}, or {fix2}, keep it"},
    {"volume-lost",
     "it would remove {volume_percent:%.0f} % of the volume: the triangles are too coarse for the "
     "vessel; {fix} leaves it out"},
    {"fewer-iterations",
     "{before} iterations would remove {volume_percent:%.0f} % of the volume, since the triangles "
     "are coarse for the vessel: {iterations#iteration was|iterations were} made"},
    {"recipe-unusable",
     "the case's recipe cannot be used, and the usual one is used instead: {reason}"},
    {"read-in-another-unit",
     "the input was read in {was}, not in {wanted}: prepare it without a unit[{advice}][; another "
     "unit is a change of the edit that read it:\n{fix}, then --resume]"},
    {"edit-leaves-zone",
     "the surface changes near {place}, outside the zone that this edit states: that part of the "
     "model was not to be touched[; give another {fix}][, or use {fix2}]"},
    {"edit-changes-triangles",
     "the edit states that it moves vertices alone, but {before#triangle} became {after}[; give "
     "another {fix}][, or use {fix2}]"},
    {"edit-changes-parts",
     "the model gets {after#part} instead of {before}: more change than the edit states[; give "
     "another {fix}][, or use {fix2}]"},
    {"edit-changes-rims",
     "the model gets {after#open end or hole|open ends and holes} instead of {before}: more change "
     "than the edit states[; give another {fix}][, or use {fix2}]"},
    {"edit-changes-handles",
     "the model gets {after#handle} instead of {before}: more change than the edit states[; give "
     "another {fix}][, or use {fix2}]"},
    {"edit-changes-volume",
     "the volume goes from {before_mm3:%.4g} to {after_mm3:%.4g} mm^3, which is more than the "
     "{stated_mm3:%.3g} mm^3 that the edit states[; give another {fix}][, or use {fix2}]"},
    {"edit-loses-wall",
     "wall near {place} is lost, {distance_mm:%.2g} mm from what is left; the edit states "
     "{stated_mm:%.2g} mm at most: a sac or a vessel's end would be gone with it[; give another "
     "{fix}][, or use {fix2}]"},
    {"edit-crosses-walls",
     "walls pass through each other near {place}: {after#pair of triangles|pairs of triangles}, "
     "{before} before the edit[; give another {fix}][, or use {fix2}]"},
    {"contact-elsewhere",
     "the narrowest place that was found, at {place}, is {distance_mm:%.2g} mm from where the "
     "contact was looked for: it may be a sac's neck or a vessel. Give another {fix}, or {fix2}"},
    {"contact-cuts-vessel",
     "the cut at {place} would go through a vessel: walls face it on {facing_percent:%.0f} % of "
     "the "
     "way around, as where nothing passes by. Give another {fix}, or {fix2}"},
    {"edit-folds-wall",
     "the wall is folded over along {edges#edge}, {share_percent:%.2g} % of those that moved, "
     "first near {place}: it would be rubble there[; give another {fix}][, or use {fix2}]"},
    {"contact-too-wide",
     "the contact at {place} is {width_mm:%.2g} mm wide, wider than the thinner vessel's diameter "
     "of {diameter_mm:%.2g} mm: what touches there is no vessel that passes, or one of them "
     "branches there, and a sac or a branch would be lost. Give another {fix}, or use {fix2}"},
    {"contact-not-alone",
     "the wall near {place} lies {height_mm:%.2g} mm from both vessels of the contact: a sac or "
     "another vessel would be lost with it. Give another {fix}, or use {fix2}"},
    {"edit-no-longer-applies",
     "edit {number} {name} no longer applies after an earlier edit was changed: {why}; change its "
     "parameters, remove it, or\n{fix}, then --resume: it chooses again what it chose "
     "automatically"},
    {"set-too-late",
     "--set '{setting}': {name} has been made already[; to change it:\n{fix}, then --resume]"},
    {"opening-in-wall",
     "the opening '{opening}' at {place} lies in a vessel's side: the end has to stay "
     "closed[\n{fix}, then --resume]"},
    {"vessels-lost",
     "the model has lost vessels:{vessels}[\nlost by edit {by}:\n{fix}, then --resume]"},
    {"step-skipped", "the step was skipped: {why}"},
    {"made-otherwise", "it was made with {arguments} instead: {why}"},
    {"thin-vessels-missing",
     "the model misses {vessels#thin vessel} of at most {diameter_mm} mm, the widest at {place}, "
     "with {flow_percent:%.3g} % of the flow"},
    {"vessels-not-compared", "lost vessels could not be looked for: {reason}"},
    {"no-pictures", "the report has no pictures: {reason}"},
    // The record and its verdicts.
    {"export-not-recorded",
     "a model that reviewers have to accept is exported only where the record can say so: "
     "{reason}"},
    {"record-contradicted",
     "the project is not what its record says, so no review of it counts; 'audit' names each "
     "contradiction"},
    {"record-missing",
     "the project has no record of its edits: it gets one when this program opens it for writing"},
    {"record-unreadable", "the project cannot be read: {reason}"},
    {"record-entry-altered", "entry {entry} of the record was altered: its hash is not that of it"},
    {"record-entry-missing",
     "the record has no entry {number}: entry {entry} follows where it belongs"},
    {"record-head-altered",
     "the record ends with entry {number}, which is not the one entered last: entries were cut off "
     "or added"},
    {"record-row-altered", "{row} is not what entry {entry} recorded: it was altered"},
    {"record-row-missing", "{row} is gone: entry {entry} recorded it"},
    {"record-row-unknown", "{row} is in no entry of the record: it was added past it"},
    {"record-data-damaged", "{row} does not have the content of its checksum: {reason}"},
    {"record-rewritten",
     "{file}: {reviewer} saw a record with the head {head}, which this one never had: it was "
     "rewritten {where}"},
    {"record-cut-off",
     "{file}: {reviewer} saw entry {number} of the record, which ends with entry {last} now: its "
     "end was cut off"},
    {"record-other-project",
     "{file}: {reviewer} reviewed {name}, a project with another id: it is another project, or the "
     "record of this one was begun anew"},
    {"signature-invalid", "the signature of the verdicts of {reviewer}, does not verify: {reason}"},
    {"replay-differs", "replaying {name} gives another result than the stored one: {differences}"},
    {"no-review-page",
     "this program was built without npm, which bundles the review page: install nodejs and npm, "
     "build it again, or review in another build"},
    {"not-accepted", "the review is not complete; missing: {edits}"},

    {"earlier-result", "{files} in this folder is of an earlier preparation, not of this model"},
    {"earlier-results", "{files} in this folder are of an earlier preparation, not of this model"},
};

}  // namespace

std::span<const CatalogueText> catalogue() {
    return kTexts;
}

}  // namespace vesselbench
