#include "workbench/window/panels/tool_bar.h"

#include <algorithm>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/panels/leaving_dialog.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

void draw_files(PanelContext& c) {
    Workplace& place = c.place;
    const bool open = place.document.is_open();
    if (icon_button(c.ui, "tool.home", icons::kHome, "Close the case and show the start screen",
                    open))
        leave(c.core, c.shown, Leaving::Case);
    ImGui::SameLine();
    if (icon_button(c.ui, "tool.open", icons::kOpen,
                    "Open a project, a surface or an image  Ctrl+O"))
        place.ask(FileQuestion::Open);
    ImGui::SameLine();
    if (icon_button(c.ui, "tool.save_copy", icons::kSave,
                    "Save as: a copy of the project. The project itself is written at every edit.",
                    open))
        place.ask(FileQuestion::SaveCopy);
    ImGui::SameLine();
    if (icon_button(c.ui, "tool.save_recipe", icons::kFile,
                    "Save the edits as a recipe, with which the same model can be made", open))
        place.ask(FileQuestion::SaveEdits);
}

void draw_undo(PanelContext& c) {
    const HistoryTree& history = c.place.history();
    const bool idle = c.place.document.can(RequestKind::History);
    const bool wide = !c.shown.compact;
    if (button(c.ui, "tool.undo", wide ? "Undo" : "",
               {.icon = icons::kUndo,
                .quiet = true,
                .enabled = history.can_undo && idle,
                .help =
                    history.can_undo ? "Undo " + history.undo_title + "  Ctrl+Z" : "Undo  Ctrl+Z"}))
        c.place.document.undo();
    ImGui::SameLine();
    if (button(c.ui, "tool.redo", wide ? "Redo" : "",
               {.icon = icons::kRedo,
                .quiet = true,
                .enabled = history.can_redo && idle,
                .help = history.can_redo ? "Redo " + history.redo_title + "  Ctrl+Shift+Z"
                                         : "Redo  Ctrl+Shift+Z"}))
        c.place.document.redo();
}

/// For what the chosen variant is made, if it is a purpose's.
void ask_for_purpose(PanelContext& c) {
    c.shown.prepare = true;
    const std::string& variant = c.place.document.variant();
    const std::vector<std::string> names = purpose_names();
    if (c.shown.purpose == variant || std::ranges::count(names, variant) == 0) return;
    c.shown.purpose = variant;
    c.shown.again_from.reset();
    c.shown.entry.reset();
}

void draw_products(PanelContext& c) {
    const Document& document = c.place.document;
    if (button(c.ui, "tool.prepare", "Prepare",
               {.icon = icons::kPrepare,
                .primary = true,
                .enabled = document.can(RequestKind::Edit),
                .help = "Run a complete recipe; its edits appear in the steps at the left"}))
        ask_for_purpose(c);
    ImGui::SameLine();
    if (button(c.ui, "tool.export", "Export",
               {.icon = icons::kExport,
                .enabled = document.can(RequestKind::Output),
                .help = "Export the model to a file"}))
        c.place.ask(FileQuestion::Export);
}

void draw_slices_toggle(PanelContext& c) {
    ImageSlices& slices = c.place.slices();
    const bool shown = slices.in_row();
    ImGui::SameLine();
    if (icon_button(c.ui, "tool.slices", icons::kColumns,
                    slices.has_image() ? "Slices of the image  I" : "No image to slice",
                    slices.has_image(), shown))
        slices.show_row(!shown);
}

std::vector<std::string> variants_of(const Document& document) {
    std::vector<std::string> variants = purpose_names();
    if (!document.is_open()) return variants;
    for (const std::string& variant : document.snapshot()->history->variants())
        if (std::ranges::count(variants, variant) == 0) variants.push_back(variant);
    if (std::ranges::count(variants, document.variant()) == 0)
        variants.push_back(document.variant());
    return variants;
}

std::string variant_help() {
    std::string help = "Steps 4 to 8 belong to a variant, the others to all:";
    for (const Purpose& purpose : purposes()) help += "\n" + purpose.title + ": " + purpose.summary;
    return help;
}

constexpr float kVariant = 16.0F, kLeastVariant = 5.0F;  ///< width [em]

void draw_variant(PanelContext& c, float width) {
    const std::vector<std::string> variants = variants_of(c.place.document);
    std::vector<std::string> labels;
    for (const std::string& variant : variants) labels.push_back(model_title(variant));
    std::string chosen = model_title(c.place.document.variant());
    if (choice(c.ui, "tool.variant", labels, chosen, width)) {
        const auto index = std::ranges::find(labels, chosen) - labels.begin();
        c.place.document.show_variant(variants[static_cast<std::size_t>(index)]);
    }
    help_on_hover(c.ui, variant_help());
}

void switch_theme(PanelContext& c) {
    c.place.settings.dark = !c.place.settings.dark;
    c.place.settings.save_soon();
}

std::string percent(double scale) {
    return formatted(100.0 * scale, "%.0f %%");
}

/// A list of sizes under the last button, while it is open.
void draw_text_sizes(PanelContext& c) {
    Settings& settings = c.place.settings;
    const ImVec2 corner{ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y};
    ImGui::SetNextWindowPos(corner);
    if (!ImGui::BeginPopup("text sizes")) return;
    for (const double scale : Settings::kScales) {
        if (ImGui::Selectable(percent(scale).c_str(), scale == settings.scale)) {
            settings.scale = scale;
            settings.save_soon();
        }
        c.ui.item("tool.text_size=" + percent(scale));
    }
    ImGui::EndPopup();
}

void draw_text_size(PanelContext& c) {
    if (icon_button(c.ui, "tool.text_size", icons::kTextSize,
                    "Text size: " + percent(c.place.settings.scale) +
                        ", as far as the window has room.  Ctrl+Plus, Ctrl+Minus, Ctrl+0"))
        ImGui::OpenPopup("text sizes");
    draw_text_sizes(c);
}

void draw_right_end(PanelContext& c, const ScreenRect& rect) {
    const Ui& ui = c.ui;
    const float frame = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
    const bool open = c.place.document.is_open();
    const float end = rect.width - ui.grid(1) - 3 * frame - 2 * gap;
    ImGui::SameLine(0, 2 * gap);
    const float room = end - 2 * gap - ImGui::GetCursorPosX();
    const float variant = std::clamp(room, ui.em * kLeastVariant, ui.em * kVariant);
    ImGui::SameLine(open ? end - 2 * gap - variant : end);
    if (open) {
        draw_variant(c, variant);
        ImGui::SameLine(0, gap * 2);
    }
    draw_text_size(c);
    ImGui::SameLine();
    const bool dark = c.place.settings.dark;
    if (icon_button(c.ui, "tool.theme", dark ? icons::kSun : icons::kMoon,
                    dark ? "Light theme" : "Dark theme"))
        switch_theme(c);
    ImGui::SameLine();
    if (icon_button(c.ui, "tool.help", icons::kHelp, "Keys and first steps  F1", true,
                    c.shown.help))
        c.shown.help = !c.shown.help;
}

void gap(const Ui& ui) {
    ImGui::SameLine(0, ui.grid(1.5F));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y + ui.grid(0.5F)},
                                        {at.x, at.y + ImGui::GetFrameHeight() - ui.grid(0.5F)},
                                        ui.theme.border);
    ImGui::Dummy({1, ImGui::GetFrameHeight()});
    ImGui::SameLine(0, ui.grid(1.5F));
}

}  // namespace

void draw_tool_bar(PanelContext& c, const ScreenRect& rect) {
    const float padding = (rect.height - ImGui::GetFrameHeight()) / 2;
    begin_frame(c.ui, "tool bar", rect, {.padding = padding, .scrolls = false});
    ImGui::SetCursorPosX(c.ui.grid(1));
    draw_files(c);
    gap(c.ui);
    draw_undo(c);
    gap(c.ui);
    draw_products(c);
    draw_slices_toggle(c);
    draw_right_end(c, rect);
    end_frame();
}

}  // namespace vesselbench
