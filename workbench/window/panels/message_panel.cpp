#include "workbench/window/panels/message_panel.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/remedies.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

const char* icon_of(MessageKind kind) {
    switch (kind) {
        case MessageKind::Remark:
            return icons::kInformation;
        case MessageKind::Success:
            return icons::kCheck;
        case MessageKind::Warning:
            return icons::kWarning;
        case MessageKind::Error:
            return icons::kError;
    }
    return "";
}

Paint colour_of(const Theme& theme, MessageKind kind) {
    switch (kind) {
        case MessageKind::Remark:
            return theme.muted;
        case MessageKind::Success:
            return theme.good;
        case MessageKind::Warning:
            return theme.warning;
        case MessageKind::Error:
            return theme.danger;
    }
    return theme.text;
}

namespace {

constexpr float kTextLeft = 7.5F;  ///< [em]

/// \param label of its remedy's button; empty: none
float buttons_width(const PanelContext& c, const Message& message, const std::string& label) {
    const float words = label.empty() ? 0 : ImGui::CalcTextSize(label.c_str()).x;
    const float target = message.place ? ImGui::GetFrameHeight() + c.ui.grid(1) : 0;
    return words + target + c.ui.grid(3);
}

/// Room right of a message's text [pixels].
float right_of(const PanelContext& c, const Message& message) {
    const std::string label = button_of(c.place.document, message);
    if (label.empty() && !message.place) return c.ui.grid(2);
    return std::max(c.ui.em * 14, buttons_width(c, message, label) + c.ui.grid(3));
}

/// Of a message's text [pixels].
float width_of(const PanelContext& c, const Message& message) {
    return ImGui::GetWindowWidth() - right_of(c, message) - c.ui.em * kTextLeft;
}

float height_of(const PanelContext& c, const Message& message) {
    const float width = width_of(c, message);
    const std::string lines = broken(message.text, width);
    const float text = ImGui::CalcTextSize(lines.c_str(), nullptr, false, width).y;
    return text + 2 * ImGui::GetStyle().FramePadding.y;
}

void draw_remedy(PanelContext& c, const Message& message, std::size_t index) {
    const std::string label = button_of(c.place.document, message);
    const float width = buttons_width(c, message, label);
    ImGui::SameLine(
        std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - width - c.ui.grid(2)));
    const std::string number = std::to_string(index);
    if (message.place && icon_button(c.ui, "message.place." + number, icons::kTarget,
                                     "Show the place in the view and in the slices"))
        c.place.look_at(*message.place);
    if (message.place && !label.empty()) ImGui::SameLine(0, c.ui.grid(1));
    if (!label.empty() && button(c.ui, "message.remedy." + number, label,
                                 {.quiet = true, .enabled = c.place.document.is_open()}))
        follow(c.core, message);
}

void draw_message(PanelContext& c, const Message& message, std::size_t index) {
    const Ui& ui = c.ui;
    ImGui::SetCursorPosX(ui.grid(1));
    ImGui::AlignTextToFramePadding();
    text(ui, message.time, ui.theme.muted);
    ImGui::SameLine(ui.em * 5.5F);
    text(ui, icon_of(message.kind), colour_of(ui.theme, message.kind));
    ImGui::SameLine(ui.em * kTextLeft);
    ImGui::PushTextWrapPos(ImGui::GetWindowWidth() - right_of(c, message));
    text(ui, broken(message.text, width_of(c, message)), ui.theme.text);
    ImGui::PopTextWrapPos();
    draw_remedy(c, message, index);
}

}  // namespace

void draw_messages(PanelContext& c) {
    const auto& all = c.place.document.messages();
    int& seen = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("seen"), 0);
    if (std::exchange(seen, c.place.document.message_changes()) != seen) ImGui::SetScrollY(0);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {c.ui.grid(1), 0});
    float y = ImGui::GetCursorPosY();
    for (std::size_t i = all.size(); i-- > 0;) {
        const float height = height_of(c, all[i]);
        ImGui::SetCursorPosY(y);
        if (ImGui::IsRectVisible({ImGui::GetWindowWidth(), height})) draw_message(c, all[i], i);
        y += height;
    }
    ImGui::SetCursorPosY(y);
    ImGui::Dummy({0, 0});
    if (all.empty()) text(c.ui, "No messages yet.", c.ui.theme.muted);
    ImGui::PopStyleVar();
}

}  // namespace vesselbench
