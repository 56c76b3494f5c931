#include "workbench/window/panels/view_panel.h"

#include <algorithm>
#include <array>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/keys/key_table.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

struct LayerToggle {
    const char* name;
    const char* label;
    KeyCommand key;
    bool ShownLayers::*layer;
};

constexpr std::array<LayerToggle, 6> kLayers = {
    {{"edges", "Triangle edges", KeyCommand::None, &ShownLayers::edges},
     {"flat", "Flat shading", KeyCommand::None, &ShownLayers::flat},
     {"source", "Source as wireframe", KeyCommand::Source, &ShownLayers::source},
     {"centerlines", "Centerlines with radii", KeyCommand::Centerlines, &ShownLayers::centerlines},
     {"names", "Opening names", KeyCommand::OpeningNames, &ShownLayers::names},
     {"anchors", "Edit locations", KeyCommand::EditLocations, &ShownLayers::anchors}}};

void draw_colour_choice(PanelContext& c) {
    std::vector<std::string> labels;
    for (const ColouringInfo& info : colourings()) labels.emplace_back(info.label);
    const ColouringInfo& now = colouring_info(c.place.view.colouring);
    std::string chosen = now.label;
    if (choice(c.ui, "view.colours", labels, chosen))
        c.place.view.choose(std::ranges::find(colourings(), chosen, &ColouringInfo::label)->kind);
    help_on_hover(c.ui, now.help);
}

void draw_range(PanelContext& c) {
    ViewChoice& view = c.place.view;
    const auto& automatic = view.automatic;
    const float gap = c.ui.grid(0.75F), side = ImGui::GetFrameHeight();
    const float width = (ImGui::GetContentRegionAvail().x - side - 2 * gap) / 2;
    const bool wrong = view.has_typed_range() && automatic && !view.range();
    const auto field = [&](const char* name, std::string& words, double value) {
        text_field(c.ui, name, words,
                   {.hint = automatic ? formatted(value) : "", .wrong = wrong, .width = width});
        ImGui::SameLine(0, gap);
    };
    field("view.least", view.least, automatic ? automatic->least : 0.0);
    field("view.most", view.most, automatic ? automatic->most : 0.0);
    if (icon_button(c.ui, "view.automatic", icons::kRefresh,
                    "Automatic range: from the 2nd to the 98th percentile", view.has_typed_range()))
        view.forget_range();
}

/// What is the matter with the colours, or what they show.
void draw_colour_remark(PanelContext& c) {
    const ViewData& data = c.place.view_data();
    const ColouringInfo& now = colouring_info(c.place.view.colouring);
    const Scene* scene = c.place.document.shown();
    const std::string missing = scene != nullptr ? why_no_colours(now.kind, *scene) : "";
    if (!missing.empty())
        wrapped(c.ui, readable_sentence(missing), c.ui.theme.warning);
    else if (data.finds_colours())
        wrapped(c.ui, "Computing", c.ui.theme.muted);
    else if (!data.colours_problem().empty())
        wrapped(c.ui, readable_sentence(data.colours_problem()), c.ui.theme.warning);
    else if (now.kind == ColouringKind::Deviation && !c.place.view.automatic &&
             !c.place.document.busy())
        wrapped(c.ui, "The model is the source: no deviation", c.ui.theme.muted);
    else
        wrapped(c.ui, now.help, c.ui.theme.muted);
}

void draw_colours(PanelContext& c) {
    group_heading(c.ui, "Colours");
    space(c.ui, 0.5F);
    draw_colour_choice(c);
    if (c.place.view.colouring != ColouringKind::Patches) draw_range(c);
    draw_colour_remark(c);
    if (c.place.view.colouring != ColouringKind::Patches &&
        button(c.ui, "view.worst", "Next worst place",
               {.icon = icons::kTarget,
                .width = ImGui::GetContentRegionAvail().x,
                .help = "Shows the worst places of these colours in turn  X, back Shift+X"}))
        c.place.get<ColoursFeature>().look_at_worst(1);
}

void draw_key(const Ui& ui, KeyCommand command, float row) {
    const std::string key = keys_of(command);
    const float wide = ImGui::CalcTextSize(key.c_str()).x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - wide);
    ImGui::SetCursorPosY(row + ImGui::GetStyle().FramePadding.y - ui.grid(0.4F));
    text(ui, key, ui.theme.muted);
}

/// A row with a mode of the view that is on or off.
bool draw_mode(PanelContext& c, const std::string& name, const std::string& label, bool on,
               KeyCommand key) {
    const float row = ImGui::GetCursorPosY();
    const bool switched = checkbox(c.ui, name, label, on);
    draw_key(c.ui, key, row);
    return switched;
}

void toggle(ClickTool& tool, ClickTool which) {
    tool = tool == which ? ClickTool::None : which;
}

void switch_clip(PanelContext& c) {
    const Scene* scene = c.place.document.shown();
    c.place.view.switch_clip(scene != nullptr && scene->volume_mesh);
}

/// Size and background of saved pictures.
void draw_picture_look(PanelContext& c) {
    const std::vector<std::string> sizes = {"1\u00D7", "2\u00D7", "4\u00D7"};
    const std::vector<std::string> backgrounds = {"As seen", "White", "Transparent"};
    PictureLook& look = c.shown.picture;
    const float gap = c.ui.grid(0.75F), wide = c.ui.em * 4;
    std::string size = sizes.at(look.factor == 4 ? 2 : look.factor == 2 ? 1 : 0);
    if (choice(c.ui, "view.picture.size", sizes, size, wide))
        look.factor = size == sizes[2] ? 4 : size == sizes[1] ? 2 : 1;
    help_on_hover(c.ui, "Size of the picture, times that of the view");
    ImGui::SameLine(0, gap);
    std::string back = backgrounds.at(static_cast<std::size_t>(look.background));
    if (choice(c.ui, "view.picture.background", backgrounds, back))
        look.background = static_cast<PictureBackground>(std::ranges::find(backgrounds, back) -
                                                         backgrounds.begin());
    help_on_hover(c.ui,
                  "Background. Larger pictures, and those on white or on nothing, show the model "
                  "alone, without legend and marks");
}

void draw_modes(PanelContext& c) {
    ViewChoice& view = c.place.view;
    group_heading(c.ui, "View modes and measuring");
    space(c.ui, 0.5F);
    if (draw_mode(c, "view.clip", "Clip plane", view.clip.on, KeyCommand::ClipPlane))
        switch_clip(c);
    if (draw_mode(c, "view.fly", "Inside the vessel", view.flies, KeyCommand::Flight))
        view.flies = !view.flies;
    if (draw_mode(c, "view.distance", "Distance", view.tool == ClickTool::Distance,
                  KeyCommand::Distance))
        toggle(view.tool, ClickTool::Distance);
    if (draw_mode(c, "view.diameter", "Diameter", view.tool == ClickTool::Diameter,
                  KeyCommand::Diameter))
        toggle(view.tool, ClickTool::Diameter);
    space(c.ui, 1);
    if (button(c.ui, "view.picture", "Save picture",
               {.icon = icons::kCamera,
                .width = ImGui::GetContentRegionAvail().x,
                .help = "Save the view as a PNG file  F12"}))
        c.place.ask(FileQuestion::Picture);
    draw_picture_look(c);
}

void draw_layers(PanelContext& c) {
    group_heading(c.ui, "Show");
    space(c.ui, 0.5F);
    for (const LayerToggle& toggle : kLayers) {
        const float row = ImGui::GetCursorPosY();
        if (checkbox(c.ui, std::string("view.show.") + toggle.name, toggle.label,
                     c.place.settings.layers.*toggle.layer))
            c.place.settings.save_soon();
        if (toggle.key != KeyCommand::None) draw_key(c.ui, toggle.key, row);
    }
}

}  // namespace

void draw_view_panel(PanelContext& c, const ScreenRect& view) {
    if (!c.shown.view) return;
    const Ui& ui = c.ui;
    const float top = view.y + ui.grid(3.5F) + ImGui::GetFrameHeight();
    const float high = std::min(ui.em * 28, view.y + view.height - top - ui.grid(1.5F));
    const float wide = ui.em * 33, column = ui.em * 15.5F;
    const ScreenRect rect{view.x + ui.grid(1.5F), top, wide, high};
    begin_frame(ui, "view options", rect, {.floats = true, .bordered = true});
    ImGui::BeginChild("colours and modes", {column, 0});
    draw_colours(c);
    space(ui, 2);
    draw_modes(c);
    ImGui::EndChild();
    ImGui::SameLine(0, ui.grid(1.5F));
    ImGui::BeginChild("layers", {column, 0});
    draw_layers(c);
    ImGui::EndChild();
    end_frame();
}

void handle_view_keys(PanelContext& c) {
    if (!c.place.document.is_open()) return;
    const KeyCommands& keys = c.shown.keys;
    if (keys.has(KeyCommand::ViewOptions)) c.shown.view = !c.shown.view;
    for (const LayerToggle& toggle : kLayers) {
        if (!keys.has(toggle.key)) continue;
        c.place.settings.layers.*toggle.layer = !(c.place.settings.layers.*toggle.layer);
        c.place.settings.save_soon();
    }
    ViewChoice& view = c.place.view;
    if (keys.has(KeyCommand::ClipPlane)) switch_clip(c);
    if (keys.has(KeyCommand::Flight)) view.flies = !view.flies;
    if (keys.has(KeyCommand::Distance)) toggle(view.tool, ClickTool::Distance);
    if (keys.has(KeyCommand::Diameter)) toggle(view.tool, ClickTool::Diameter);
    if (keys.has(KeyCommand::Picture)) c.place.ask(FileQuestion::Picture);
}

bool leave_view_mode(PanelContext& c) {
    ViewChoice& view = c.place.view;
    if (view.tool != ClickTool::None)
        view.tool = ClickTool::None;
    else if (view.flies)
        view.flies = false;
    else if (c.shown.view)
        c.shown.view = false;
    else if (c.shown.enlarged != Enlarged::None)
        c.shown.enlarged = Enlarged::None;
    else
        return false;
    return true;
}

}  // namespace vesselbench
