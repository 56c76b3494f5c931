#include "geometry/kernel/catalogue_projects.h"

namespace vesselbench {

namespace {

constexpr CatalogueText kTexts[] = {
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
     "the edit states that it moves vertices alone, but {before#triangle} became {after}[, near "
     "{place}][; give another {fix}][, or use {fix2}]"},
    {"edit-changes-parts",
     "the model gets {after#part} instead of {before}[, near {place}]: more change than the edit "
     "states[; give another {fix}][, or use {fix2}]"},
    {"edit-changes-rims",
     "the model gets {after#open end or hole|open ends and holes} instead of {before}[, near "
     "{place}]: more change than the edit states[; give another {fix}][, or use {fix2}]"},
    {"edit-changes-handles",
     "the model gets {after#handle} instead of {before}[, near {place}]: more change than the edit "
     "states[; give another {fix}][, or use {fix2}]"},
    {"edit-changes-volume",
     "the volume goes from {before_mm3:%.4g} to {after_mm3:%.4g} mm^3[, most of it near {place}], "
     "which is more than the {stated_mm3:%.3g} mm^3 that the edit states[; give another {fix}][, "
     "or "
     "use {fix2}]"},
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
    {"made-without-stack",
     "it was made with {arguments}: the surface has no image, and too few staircases to find the "
     "direction of its slices by",
     kNote},
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

std::span<const CatalogueText> project_texts() {
    return kTexts;
}

}  // namespace vesselbench
