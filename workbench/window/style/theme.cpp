#include "workbench/window/style/theme.h"

#include <imgui.h>

namespace vesselbench {

namespace {

/// Sizes in the style are given for a text of this size [pixels].
constexpr float kDesignedFor = 15.0F;

ImVec4 vec(Paint colour) {
    return ImGui::ColorConvertU32ToFloat4(colour);
}

void set_sizes(ImGuiStyle& style, float unit) {
    style.WindowPadding = {12 * unit, 12 * unit};
    style.FramePadding = {10 * unit, 6 * unit};
    style.ItemSpacing = {8 * unit, 8 * unit};
    style.ItemInnerSpacing = {8 * unit, 4 * unit};
    style.CellPadding = {8 * unit, 4 * unit};
    style.IndentSpacing = 16 * unit;
    style.ScrollbarSize = 10 * unit;
    style.GrabMinSize = 10 * unit;
    style.WindowRounding = style.ChildRounding = 0.0F;
    style.FrameRounding = style.PopupRounding = style.GrabRounding = style.TabRounding = 4 * unit;
    style.ScrollbarRounding = 5 * unit;
    style.WindowBorderSize = style.ChildBorderSize = 0.0F;
    style.FrameBorderSize = style.PopupBorderSize = 1.0F;
    style.WindowMinSize = {1, 1};
    style.DisabledAlpha = 0.45F;
    style.AntiAliasedLinesUseTex = false;
}

void set_colours(ImVec4* colours, const Theme& theme) {
    colours[ImGuiCol_Text] = vec(theme.text);
    colours[ImGuiCol_TextDisabled] = vec(theme.muted);
    colours[ImGuiCol_TextSelectedBg] = vec(faded(theme.accent, 0.4));
    colours[ImGuiCol_WindowBg] = colours[ImGuiCol_ChildBg] = vec(theme.panel);
    colours[ImGuiCol_PopupBg] = vec(theme.raised);
    colours[ImGuiCol_Border] = vec(theme.border);
    colours[ImGuiCol_BorderShadow] = vec(0);
    colours[ImGuiCol_FrameBg] = vec(theme.field);
    colours[ImGuiCol_FrameBgHovered] = colours[ImGuiCol_FrameBgActive] = vec(theme.field);
    colours[ImGuiCol_ScrollbarBg] = vec(0);
    colours[ImGuiCol_ScrollbarGrab] = vec(faded(theme.muted, 0.35));
    colours[ImGuiCol_ScrollbarGrabHovered] = vec(faded(theme.muted, 0.55));
    colours[ImGuiCol_ScrollbarGrabActive] = vec(faded(theme.muted, 0.7));
    colours[ImGuiCol_CheckMark] = vec(theme.accent);
    colours[ImGuiCol_Button] = vec(theme.raised);
    colours[ImGuiCol_ButtonHovered] = colours[ImGuiCol_ButtonActive] = vec(theme.hover);
    colours[ImGuiCol_Header] = vec(theme.selected);
    colours[ImGuiCol_HeaderHovered] = colours[ImGuiCol_HeaderActive] = vec(theme.hover);
    colours[ImGuiCol_Separator] = vec(theme.border);
    colours[ImGuiCol_PlotHistogram] = vec(theme.accent);
    colours[ImGuiCol_ModalWindowDimBg] = vec(paint(0x000000, theme.dark ? 150 : 90));
    colours[ImGuiCol_NavHighlight] = vec(theme.accent);
}

}  // namespace

Theme dark_theme() {
    return {.dark = true,
            .window = paint(0x14171B),
            .panel = paint(0x1D2126),
            .raised = paint(0x282D34),
            .hover = paint(0x333942),
            .field = paint(0x14171B),
            .border = paint(0x363C45),
            .text = paint(0xE6E9ED),
            .muted = paint(0x98A2AE),
            .accent = paint(0x3E8FD0),
            .accent_hover = paint(0x56A2DE),
            .on_accent = paint(0xFFFFFF),
            .selected = paint(0x23405A),
            .good = paint(0x56B886),
            .warning = paint(0xE0A945),
            .danger = paint(0xE56B62),
            .view_above = paint(0x39414B),
            .view_below = paint(0x191C20)};
}

Theme light_theme() {
    return {.dark = false,
            .window = paint(0xDDE1E6),
            .panel = paint(0xF7F8FA),
            .raised = paint(0xFFFFFF),
            .hover = paint(0xE6EAEF),
            .field = paint(0xFFFFFF),
            .border = paint(0xCAD0D8),
            .text = paint(0x1C2530),
            .muted = paint(0x5D6875),
            .accent = paint(0x1F6DB2),
            .accent_hover = paint(0x2B7EC6),
            .on_accent = paint(0xFFFFFF),
            .selected = paint(0xD5E6F5),
            .good = paint(0x25865A),
            .warning = paint(0xA86E00),
            .danger = paint(0xC0392F),
            .view_above = paint(0xFFFFFF),
            .view_below = paint(0xCDD4DC)};
}

void apply_theme(const Theme& theme, float em) {
    ImGuiStyle& style = ImGui::GetStyle();
    set_sizes(style, em / kDesignedFor);
    set_colours(style.Colors, theme);
}

}  // namespace vesselbench
