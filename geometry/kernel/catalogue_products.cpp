#include "geometry/kernel/catalogue_products.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
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
    {"outlet-without-line",
     "openfoam.outlets=bifurcations: no centerline joins {opening} with the other openings; give "
     "openfoam.outlets=area, cubes or zero-pressure"},
};

}  // namespace

std::span<const CatalogueText> product_texts() {
    return kTexts;
}

}  // namespace vesselbench
