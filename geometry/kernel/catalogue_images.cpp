#include "geometry/kernel/catalogue_images.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
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
     "cut_1 ...)",
     kNote},
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
};

}  // namespace

std::span<const CatalogueText> image_texts() {
    return kTexts;
}

}  // namespace vesselbench
