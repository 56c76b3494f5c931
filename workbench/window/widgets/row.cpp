#include "workbench/window/widgets/row.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

/// Where the parts of a row go [pixels].
struct Places {
    ImVec2 from, to;
    float title_y = 0, detail_y = 0, icon_x = 0, text_x = 0, text_end = 0;
};

float width_of(ImFont* font, const std::string& words) {
    return font->CalcTextSizeA(font->FontSize, 1e6F, 0.0F, words.c_str()).x;
}

Places places_of(const Ui& ui, const RowLook& look) {
    Places places;
    places.from = ImGui::GetItemRectMin();
    places.to = ImGui::GetItemRectMax();
    const float pad = ui.grid(1);
    const float lines = look.detail.empty() ? ui.em : ui.em * 2.2F;
    places.title_y = places.from.y + (places.to.y - places.from.y - lines) / 2 - ui.em * 0.04F;
    places.detail_y = places.title_y + ui.em * 1.3F;
    places.icon_x = places.from.x + pad + look.indent;
    places.text_x = places.icon_x + (*look.icon == '\0' ? 0 : ui.em * 1.7F);
    const float right = look.right.empty() ? 0 : width_of(ui.fonts.small, look.right) + pad;
    places.text_end = places.to.x - pad - right;
    return places;
}

void draw_background(const Ui& ui, const RowLook& look, const Places& places) {
    const bool hovered = look.enabled && ImGui::IsItemHovered();
    const Paint back = look.selected ? ui.theme.selected : hovered ? ui.theme.hover : 0;
    if (back != 0)
        ImGui::GetWindowDrawList()->AddRectFilled(places.from, places.to, back,
                                                  ImGui::GetStyle().FrameRounding);
}

void draw_line(ImFont* font, ImVec2 at, Paint colour, const std::string& words, float width) {
    ImGui::PushFont(font);
    ImGui::GetWindowDrawList()->AddText(at, colour, fitted(words, width).c_str());
    ImGui::PopFont();
}

void draw_texts(const Ui& ui, const RowLook& look, const Places& places) {
    const Theme& theme = ui.theme;
    const float width = places.text_end - places.text_x;
    const Paint icon = look.icon_colour == 0 ? theme.muted : look.icon_colour;
    draw_line(ui.fonts.regular, {places.icon_x, places.title_y}, icon, look.icon, ui.em * 2);
    draw_line(look.strong ? ui.fonts.medium : ui.fonts.regular, {places.text_x, places.title_y},
              look.enabled ? theme.text : theme.muted, look.title, width);
    if (!look.detail.empty())
        draw_line(ui.fonts.small, {places.text_x, places.detail_y}, theme.muted, look.detail,
                  width);
    if (!look.right.empty())
        draw_line(ui.fonts.small, {places.text_end + ui.grid(1), places.title_y + ui.em * 0.08F},
                  theme.muted, look.right, 1e6F);
}

}  // namespace

float row_height(const Ui& ui, bool detail) {
    return detail ? ui.em * 3.07F : ui.em * 1.87F;
}

bool row(Ui& ui, const std::string& name, const RowLook& look) {
    const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x);
    const bool clicked =
        ImGui::InvisibleButton(name.c_str(), {width, row_height(ui, !look.detail.empty())});
    ui.item(name, look.enabled);
    ui.say(name, look.title);
    if (ImGui::IsItemVisible()) {
        const Places places = places_of(ui, look);
        draw_background(ui, look, places);
        draw_texts(ui, look, places);
    }
    if (!look.help.empty()) help_on_hover(ui, look.help);
    return clicked && look.enabled;
}

bool row_double_clicked() {
    return ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
}

}  // namespace vesselbench
