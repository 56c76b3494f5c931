#include "workbench/window/features/colours/colours_feature.h"

#include "workbench/window/case/readable.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/live/live_feature.h"

namespace vesselbench {

bool ColoursFeature::update() {
    return view_data_.update(core_.document, core_.view, core_.settings.layers);
}

std::string ColoursFeature::why_no_worst() const {
    if (core_.view.colouring == ColouringKind::Patches)
        return "Choose colours first: their worst places are shown in turn";
    if (core_.get<LiveFeature>().live().shown() && !has_live_colours(core_.view.colouring))
        return "These colours do not follow the model while it is smoothed live";
    return "The colours are not known yet";
}

void ColoursFeature::look_at_worst(int steps) {
    Document& document = core_.document;
    const ColouringInfo& info = colouring_info(core_.view.colouring);
    const auto found = worst_.go(
        {document, view_data_, core_.get<LiveFeature>().live().shown(), core_.view.colouring},
        steps);
    if (!found) return document.tell(make_message(MessageKind::Remark, why_no_worst()));
    core_.look_at(found->place, found->outward);
    std::string words = std::string(info.label) + " " + readable_number(found->value);
    if (std::string(info.unit) != "-") words += std::string(" ") + info.unit;
    if (found->sharpness) words += ", change of orientation " + readable_number(*found->sharpness);
    document.tell(make_message(MessageKind::Remark, words + ": worst place " + worst_.position()));
}

void ColoursFeature::keys(PanelContext& context) {
    if (!core_.document.is_open()) return;
    if (context.shown.keys.has(KeyCommand::NextWorst)) look_at_worst(1);
    if (context.shown.keys.has(KeyCommand::PreviousWorst)) look_at_worst(-1);
}

}  // namespace vesselbench
