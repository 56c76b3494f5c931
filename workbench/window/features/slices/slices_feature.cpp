#include "workbench/window/features/slices/slices_feature.h"

#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"

namespace vesselbench {

bool SlicesFeature::update() {
    return slices_.update(core_.document.shown(), outline_.get());
}

/// The slices, or their planes in the 3D view.
void SlicesFeature::keys(PanelContext& context) {
    if (!slices_.has_image()) return;
    const KeyCommands& keys = context.shown.keys;
    if (keys.has(KeyCommand::SlicePlanes)) slices_.show_in_space(!slices_.any_in_space());
    if (keys.has(KeyCommand::SliceRow)) slices_.show_row(!slices_.in_row());
}

/// A region of the image is seen in its slices.
void SlicesFeature::form_shown() {
    if (has_field(*core_.form(), Meaning::Box)) slices_.lend_row(true);
}

void SlicesFeature::parameter_armed(PickTarget target) {
    if (is_in_slices(target)) slices_.show_row(true);
}

}  // namespace vesselbench
