#include "geometry/kernel/catalogue_edits.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
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
    {"orientation-reversed", "the surface was inside out; its orientation was reversed", kNote},
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
     "does|pairs of triangles still do}: use fewer {fix}, or {fix2}]",
     kNote},
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
};

}  // namespace

std::span<const CatalogueText> edit_texts() {
    return kTexts;
}

}  // namespace vesselbench
