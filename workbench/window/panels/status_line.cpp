#include "workbench/window/panels/status_line.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/panels/message_panel.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

constexpr float kProgressShare = 0.55F;  ///< of the line, for what runs

float text_top(const Ui& ui) {
    return (ImGui::GetWindowHeight() - ui.em) / 2;
}

/// Nothing where there is no room for it before `end` [pixels].
void figure(const Ui& ui, float end, const std::string& name, const std::string& value,
            const std::string& help = {}) {
    const float wide = ImGui::CalcTextSize(name.c_str()).x + ImGui::CalcTextSize(value.c_str()).x;
    if (ImGui::GetCursorPosX() + wide + ui.grid(1.75F) > end) return;
    text(ui, name, ui.theme.muted);
    ImGui::SameLine(0, ui.grid(0.75F));
    text(ui, value, ui.theme.text);
    if (!help.empty()) help_on_hover(ui, help);
    ImGui::SameLine(0, ui.grid(3));
}

void draw_inside_out(Ui& ui) {
    text(ui, "Inside out", ui.theme.warning);
    help_on_hover(ui,
                  "The surface's normals point inward, so its colours are not visible. "
                  "Repair reverses its orientation");
    ui.item("status.inside_out");
    ImGui::SameLine(0, ui.grid(3));
}

/// \param end where the room for them ends [pixels]
void draw_figures(PanelContext& c, float end) {
    const Document& document = c.place.document;
    const Scene* scene = document.shown();
    if (scene == nullptr) return;
    if (scene->surface) figure(c.ui, end, "Triangles", grouped(scene->surface->triangle_count()));
    if (scene->volume_mesh)
        figure(c.ui, end, "Tetrahedra", grouped(scene->volume_mesh->tetrahedra.size()));
    if (scene->volume_mesh && !scene->volume_mesh->prisms.empty())
        figure(c.ui, end, "Prisms", grouped(scene->volume_mesh->prisms.size()));
    const ShownFigures& figures = document.figures();
    const SurfaceChange* change =
        document.previewed() ? &document.previewed()->result().change : nullptr;
    const auto volume = change != nullptr ? change->volume_after : figures.volume;
    if (volume) figure(c.ui, end, "Volume", readable_number(*volume) + " mm\u00B3");
    if (change == nullptr && figures.inside_out) draw_inside_out(c.ui);
    if (change != nullptr && change->largest_deviation)
        figure(c.ui, end, "Preview differs by up to",
               readable_number(*change->largest_deviation) + " mm");
    else if (figures.deviation)
        figure(
            c.ui, end, "Deviation from source",
            "mean " + readable_number(figures.deviation->mean) + ", largest " +
                readable_number(figures.deviation->largest) + " mm",
            "Distance of the shown wall from the source, without removed parts and what was made "
            "at the ends");
}

void draw_progress(PanelContext& c, const Activity& activity, float width) {
    const Ui& ui = c.ui;
    const float high = ui.em * 0.4F, bar = ui.em * 9, side = ImGui::GetFrameHeight();
    const std::string words =
        fitted(readable_sentence(activity.what), width - bar - side - ui.grid(4));
    const float total = ImGui::CalcTextSize(words.c_str()).x + bar + side + ui.grid(2.5F);
    ImGui::SetCursorPos({ImGui::GetWindowWidth() - total - ui.grid(1), text_top(ui)});
    text(ui, words, ui.theme.text);
    ImGui::SameLine(0, ui.grid(1));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + (ui.em - high) / 2 + ui.em * 0.05F;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x, y}, {at.x + bar, y + high}, ui.theme.hover, high / 2);
    const float done = std::max(high, bar * static_cast<float>(activity.fraction));
    draw.AddRectFilled({at.x, y}, {at.x + done, y + high}, ui.theme.accent, high / 2);
    ImGui::Dummy({bar, ui.em});
    ImGui::SameLine(0, ui.grid(0.5F));
    ImGui::SetCursorPosY((ImGui::GetWindowHeight() - side) / 2);
    if (icon_button(c.ui, "status.cancel", icons::kClose, "Cancel  Esc")) c.place.document.cancel();
}

/// The newest message, in the room that the figures leave.
void draw_news(PanelContext& c, float width) {
    const auto& messages = c.place.document.messages();
    if (messages.empty() || width < c.ui.em * 10) return;
    const Message& newest = messages.back();
    text(c.ui, icon_of(newest.kind), colour_of(c.ui.theme, newest.kind));
    ImGui::SameLine(0, c.ui.grid(0.75F));
    text(c.ui, fitted(newest.text, width - c.ui.em * 2), c.ui.theme.muted);
    if (ImGui::IsItemClicked()) c.shown.bottom = BottomTab::Messages;
    help_on_hover(c.ui, newest.text);
    c.ui.item("status.news");
}

std::string device_words(const PanelContext& c) {
    return fitted("mm    " + c.device, c.ui.em * 20);
}

/// Where the words about the device begin.
float device_place(const PanelContext& c, float width) {
    return width - ImGui::CalcTextSize(device_words(c).c_str()).x - c.ui.grid(2);
}

/// The newest message and the device.
void draw_idle(PanelContext& c, float width) {
    const Ui& ui = c.ui;
    const std::string words = device_words(c);
    const float device = device_place(c, width);
    if (c.place.document.is_open()) draw_news(c, device - ImGui::GetCursorPosX() - ui.grid(3));
    ImGui::SetCursorPos({device, text_top(ui)});
    text(ui, words, ui.theme.muted);
    help_on_hover(ui, "Lengths are in millimetres. OpenGL device: " + c.device);
}

}  // namespace

void draw_status_line(PanelContext& c, const ScreenRect& rect) {
    begin_frame(c.ui, "status", rect, {.padding = 0, .scrolls = false});
    ImGui::PushFont(c.ui.fonts.small);
    ImGui::SetCursorPos({c.ui.grid(2), text_top(c.ui)});
    const auto activity = c.place.document.activity();
    draw_figures(c, activity ? rect.width * (1 - kProgressShare) : device_place(c, rect.width));
    if (activity)
        draw_progress(c, *activity, rect.width * kProgressShare);
    else
        draw_idle(c, rect.width);
    ImGui::PopFont();
    end_frame();
}

}  // namespace vesselbench
