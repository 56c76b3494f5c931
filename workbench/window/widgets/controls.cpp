#include "workbench/window/widgets/controls.h"

#include <algorithm>
#include <cctype>
#include <cfloat>

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "workbench/window/style/icons.h"

namespace vesselbench {

namespace {

std::string with_icon(const char* icon, const std::string& label) {
    if (*icon == '\0') return label;
    return label.empty() ? icon : std::string(icon) + "  " + label;
}

void push_button_colours(const Theme& theme, const ButtonLook& look) {
    const Paint back = look.primary ? theme.accent : look.quiet ? 0 : theme.raised;
    const Paint hover = look.primary ? theme.accent_hover : theme.hover;
    ImGui::PushStyleColor(ImGuiCol_Button, back);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, hover);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, hover);
    ImGui::PushStyleColor(ImGuiCol_Border, look.primary || look.quiet ? 0 : theme.border);
    ImGui::PushStyleColor(ImGuiCol_Text, look.primary ? theme.on_accent : theme.text);
}

/// The frame of the last item, drawn over it.
void outline(const Ui& ui, Paint colour) {
    ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), colour,
                                        ImGui::GetStyle().FrameRounding, 0,
                                        std::max(1.0F, ui.em / 12.0F));
}

/// Bytes of a text's beginning that is narrower than `width`, in whole characters. Reads no more
/// than these.
std::size_t end_within(const std::string& words, float width) {
    const char* end = words.data();
    ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), std::max(0.0F, width), 0.0F, words.data(),
                                    words.data() + words.size(), &end);
    return static_cast<std::size_t>(end - words.data());
}

}  // namespace

bool button(Ui& ui, const std::string& name, const std::string& label, const ButtonLook& look) {
    const std::string shown = with_icon(look.icon, label) + "##" + name;
    push_button_colours(ui.theme, look);
    ImGui::BeginDisabled(!look.enabled);
    if (look.primary) ImGui::PushFont(ui.fonts.medium);
    const bool clicked = ImGui::Button(shown.c_str(), {look.width, 0});
    if (look.primary) ImGui::PopFont();
    ImGui::EndDisabled();
    ImGui::PopStyleColor(5);
    ui.item(name, look.enabled);
    ui.say(name, label);
    if (!look.help.empty()) help_on_hover(ui, look.help);
    return clicked;
}

bool icon_button(Ui& ui, const std::string& name, const char* icon, const std::string& help,
                 bool enabled, bool pressed) {
    const float side = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_Button, pressed ? ui.theme.selected : 0);
    ImGui::PushStyleColor(ImGuiCol_Border, Paint{0});
    ImGui::BeginDisabled(!enabled);
    const bool clicked = ImGui::Button((std::string(icon) + "##" + name).c_str(), {side, side});
    ImGui::EndDisabled();
    ImGui::PopStyleColor(2);
    ImGui::PopStyleVar();
    ui.item(name, enabled);
    help_on_hover(ui, help);
    return clicked;
}

bool text_field(Ui& ui, const std::string& name, std::string& text, const FieldLook& look) {
    ImGui::SetNextItemWidth(look.width);
    if (look.focus) ImGui::SetKeyboardFocusHere();
    const bool changed = ImGui::InputTextWithHint(("##" + name).c_str(), look.hint.c_str(), &text);
    if (look.wrong)
        outline(ui, ui.theme.danger);
    else if (ImGui::IsItemActive())
        outline(ui, ui.theme.accent);
    ui.item(name);
    return changed;
}

bool choice(Ui& ui, const std::string& name, const std::vector<std::string>& options,
            std::string& chosen, float width) {
    ImGui::SetNextItemWidth(width);
    const float wide = ImGui::CalcItemWidth(), right = ImGui::GetCursorScreenPos().x + wide;
    const bool open =
        ImGui::BeginCombo(("##" + name).c_str(), chosen.c_str(),
                          ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton);
    if (!open) {
        const float y = ImGui::GetItemRectMin().y + ImGui::GetStyle().FramePadding.y;
        ImGui::GetWindowDrawList()->AddText({right - ui.em * 1.7F, y}, ui.theme.muted,
                                            icons::kDown);
        ui.item(name);
        return false;
    }
    bool changed = false;
    for (const std::string& option : options) {
        if (ImGui::Selectable(option.c_str(), option == chosen)) {
            changed = option != chosen;
            chosen = option;
        }
        ui.item(name + "=" + option);
    }
    ImGui::EndCombo();
    return changed;
}

bool checkbox(Ui& ui, const std::string& name, const std::string& label, bool& on) {
    const float padding = ui.grid(0.4F);
    const float lower = (ImGui::GetFrameHeight() - ui.em - 2 * padding) / 2;
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + lower);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {padding, padding});
    const bool changed = ImGui::Checkbox((label + "##" + name).c_str(), &on);
    ImGui::PopStyleVar();
    ui.item(name);
    return changed;
}

void text(const Ui&, const std::string& words, Paint colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(words.c_str());
    ImGui::PopStyleColor();
}

void small_text(const Ui& ui, const std::string& words, Paint colour) {
    ImGui::PushFont(ui.fonts.small);
    text(ui, words, colour);
    ImGui::PopFont();
}

void wrapped(const Ui& ui, const std::string& words, Paint colour, bool small) {
    ImGui::PushFont(small ? ui.fonts.small : ui.fonts.regular);
    ImGui::PushTextWrapPos(0.0F);
    text(ui, broken(words, ImGui::GetContentRegionAvail().x), colour);
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
}

void heading(const Ui& ui, const std::string& words) {
    ImGui::PushFont(ui.fonts.heading);
    text(ui, words, ui.theme.text);
    ImGui::PopFont();
}

void group_heading(const Ui& ui, const std::string& words) {
    std::string capitals = words;
    std::ranges::transform(capitals, capitals.begin(),
                           [](unsigned char c) { return std::toupper(c); });
    ImGui::PushFont(ui.fonts.small);
    text(ui, capitals, ui.theme.muted);
    ImGui::PopFont();
}

std::string broken(const std::string& words, float width) {
    // ImGui::CalcTextSize rounds up: over the words of a line, that would add up.
    const auto width_of = [](const char* from, const char* to) {
        return ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), FLT_MAX, 0.0F, from, to).x;
    };
    const std::string space = " ";
    const float blank = width_of(space.data(), space.data() + 1);
    std::string lines;
    float used = 0;
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find_first_of(" \n", at), words.size());
        const float wide = width_of(words.data() + at, words.data() + end);
        if (used > 0 && used + wide > width && lines.ends_with(' ')) {
            lines.back() = '\n';
            used = 0;
        }
        lines.append(words, at, std::min(end + 1, words.size()) - at);
        const bool ends_line = end < words.size() && words[end] == '\n';
        used = ends_line ? 0 : used + wide + blank;
        at = end + 1;
    }
    return lines;
}

std::string fitted(const std::string& words, float width) {
    constexpr float kRounding = 0.5F;  // widths that callers measure are whole pixels
    if (end_within(words, width + kRounding) == words.size()) return words;
    const float room = width - ImGui::CalcTextSize("\u2026").x;
    return words.substr(0, end_within(words, room)) + "\u2026";
}

void take_keyboard() {
    if (ImGui::GetIO().WantTextInput) ImGui::ClearActiveID();
}

void clipped_text(const Ui& ui, const std::string& words, Paint colour, float width) {
    const std::string shown = fitted(words, width);
    text(ui, shown, colour);
    if (shown != words) help_on_hover(ui, words);
}

void help_on_hover(const Ui& ui, const std::string& words) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) tooltip(ui, words);
}

void tooltip(const Ui& ui, const std::string& words) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.grid(1.25F), ui.grid(1)});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ui.em * 24);
    text(ui, broken(words, ui.em * 24 - ImGui::GetCursorPosX()), ui.theme.text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void space(const Ui& ui, float count) {
    ImGui::Dummy({0, std::max(0.0F, ui.grid(count) - ImGui::GetStyle().ItemSpacing.y)});
}

void separator(const Ui& ui) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y},
                                        ui.theme.border);
    ImGui::Dummy({0, 1});
}

}  // namespace vesselbench
