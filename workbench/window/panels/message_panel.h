#pragma once

#include "workbench/window/case/message.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/style/theme.h"

namespace vesselbench {

/// All messages, newest first, with their remedies as buttons.
void draw_messages(PanelContext& context);

/// The icon and colour of a kind of message.
[[nodiscard]] const char* icon_of(MessageKind kind);
[[nodiscard]] Paint colour_of(const Theme& theme, MessageKind kind);

}  // namespace vesselbench
