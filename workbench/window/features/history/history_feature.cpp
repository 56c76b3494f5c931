#include "workbench/window/features/history/history_feature.h"

#include "workbench/window/core/panel_context.h"
#include "workbench/window/core/shown.h"

namespace vesselbench {

void HistoryFeature::keys(PanelContext& context) {
    if (!core_.document.can(RequestKind::History)) return;
    const HistoryTree& history = core_.history();
    if (context.shown.keys.has(KeyCommand::Undo) && history.can_undo) core_.document.undo();
    if (context.shown.keys.has(KeyCommand::Redo) && history.can_redo) core_.document.redo();
}

}  // namespace vesselbench
