#include "workbench/window/view/view_tools.h"

#include <string>

#include <imgui.h>

#include "workbench/operations/table.h"
#include "workbench/window/core/layout.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

bool draw_tool(PanelContext& c, const std::string& name, const char* icon, const std::string& help,
               bool on) {
    ImGui::SameLine(0, c.ui.grid(0.25F));
    return icon_button(c.ui, name, icon, help, true, on);
}

/// A button that switches something.
void draw_switch(PanelContext& c, const std::string& name, const char* icon,
                 const std::string& help, bool& on) {
    if (draw_tool(c, name, icon, help, on)) on = !on;
}

/// The plate under so many buttons, at whose first one ImGui's cursor is put.
void draw_back(const Ui& ui, const ScreenRect& view, float count) {
    const float pad = ui.grid(0.5F), side = ImGui::GetFrameHeight();
    const float width = count * side + (count - 1) * ui.grid(0.25F) + 2 * pad;
    const ImVec2 at{view.x + ui.grid(1.5F), view.y + ui.grid(1.5F)};
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + side + 2 * pad},
                                              faded(ui.theme.panel, 0.9),
                                              ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos({at.x + pad, at.y + pad});
}

void draw_layer_switches(PanelContext& c) {
    ShownLayers& layers = c.place.settings.layers;
    const ShownLayers before = layers;
    draw_switch(c, "view.edges", icons::kGrid, "Triangle edges", layers.edges);
    draw_switch(c, "view.flat", icons::kFlat, "Flat shading", layers.flat);
    if (layers != before) c.place.settings.save_soon();
}

void draw_colour_switch(PanelContext& c) {
    ViewChoice& choice = c.place.view;
    const bool coloured = choice.colouring != ColouringKind::Patches;
    const std::string help = std::string("Colours: ") + colouring_info(choice.last_colouring).label;
    if (draw_tool(c, "view.deviation", icons::kPalette, help, coloured))
        choice.choose(coloured ? ColouringKind::Patches : choice.last_colouring);
}

void draw_slice_switch(PanelContext& c) {
    ImageSlices& slices = c.place.slices();
    const bool shown = slices.any_in_space();
    if (draw_tool(c, "view.slices", icons::kImage, "Planes of the image  Shift+I", shown))
        slices.show_in_space(!shown);
}

std::string deviation_title(const PanelContext& c, const ViewScene& scene) {
    if (scene.compared().colours_model()) return "Distance from the reference [mm]";
    return c.place.document.previewed() || c.place.live().shown()
               ? "Distance from the unmodified surface [mm]"
               : "Distance from the source [mm]";
}

/// The values whose colours are drawn; null: none.
ClippedCount::Values drawn_values(const PanelContext& c, const ViewScene& scene) {
    const auto& colours = c.place.view_data().colours();
    if (!scene.clip().shows_tetrahedra()) return scene.model().values();
    return colours ? ClippedCount::Values(colours, &colours->values) : nullptr;
}

/// None: the colours are those of patches.
std::optional<ColourLegend> legend_of(const PanelContext& c, const ViewScene& scene,
                                      ClippedCount& clipped) {
    const bool cells = scene.clip().shows_tetrahedra();
    const ValueRange range = cells ? scene.clip().range() : scene.model().colour_range();
    ColourLegend legend{.least = range.least, .most = range.most};
    if (cells || scene.model().shows_colouring()) {
        const ColouringInfo& info = colouring_info(c.place.view.colouring);
        legend.title = std::string(info.label) + " [" + info.unit + "]";
    } else if (scene.model().shows_deviation(scene.model_look())) {
        legend.map = ColourMap::Diverging;
        legend.title = deviation_title(c, scene);
    } else {
        return std::nullopt;
    }
    legend.remark = clipped_words(clipped.of(drawn_values(c, scene), range));
    return legend;
}

std::string empty_words(const PanelContext& c, const ViewScene& scene) {
    const Scene* shown = c.place.document.shown();
    if (!scene.model().problem().empty()) return "The model cannot be drawn: see Messages";
    if (shown == nullptr || scene.model().pending()) return "Reading the model";
    return shown->image ? "The image has no surface yet" : "The case is empty";
}

}  // namespace

ToolRequests draw_view_tools(PanelContext& c, const ScreenRect& view, bool perspective) {
    ToolRequests asked;
    const bool has_image = c.place.slices().has_image();
    draw_back(c.ui, view, has_image ? 8.0F : 7.0F);
    asked.frame = icon_button(c.ui, "view.fit", icons::kFit, "Show everything  Home");
    draw_layer_switches(c);
    draw_switch(c, "view.transparent", icons::kTransparent, "Transparent",
                c.place.view.transparent);
    draw_colour_switch(c);
    asked.switch_perspective =
        draw_tool(c, "view.perspective", icons::kPerspective, "Perspective  5", perspective);
    draw_switch(c, "view.options", icons::kLayers,
                "Colours, sections, overlays and measurements  V", c.shown.view);
    if (has_image) draw_slice_switch(c);
    return asked;
}

void draw_legend(const PanelContext& c, const ViewScene& scene, ClippedCount& clipped) {
    if (scene.hides_model()) return;
    const auto legend = legend_of(c, scene, clipped);
    if (!legend) return;
    ScreenRect place = scene.rect();
    if (scene.compared().colours_model()) place.y += c.ui.em * 1.5F;             // below its banner
    if (c.place.document.stands_before() != nullptr) place.y += c.ui.em * 3.5F;  // its banner
    const bool live = c.place.live().follows() || c.place.extraction().follows();
    if (live) place.y += c.ui.em * (scene.gallery().magnifies() ? 6.5F : 3.5F);  // below its banner
    draw_colour_legend(c.ui, place, *legend);
}

void draw_empty_view(PanelContext& c, const ViewScene& scene) {
    const ScreenRect& rect = scene.rect();
    const float wide = c.ui.em * 12, x = rect.middle_x(), y = rect.middle_y();
    if (scene.has_content()) {  // the image's planes; beside them, and below buttons without room
        const float gap = c.ui.grid(1.5F);
        const bool beside = rect.width > kViewToolsWidth * c.ui.em + wide + 2 * gap;
        const float below = beside ? 0.0F : ImGui::GetFrameHeight() + c.ui.grid(3);
        ImGui::SetCursorScreenPos({rect.x + rect.width - wide - gap, rect.y + gap + below});
    } else {
        const std::string words = empty_words(c, scene);
        ImGui::SetCursorScreenPos({x - ImGui::CalcTextSize(words.c_str()).x / 2, y - c.ui.em * 2});
        text(c.ui, words, c.ui.theme.text);
        ImGui::SetCursorScreenPos({x - wide / 2, y - c.ui.em * 0.5F});
    }
    const Scene* shown = c.place.document.shown();
    if (shown == nullptr || !shown->image || c.place.form()) return;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (button(c.ui, "view.extract", "Extract surface", {.primary = true, .width = wide}))
        return c.place.choose(extracting_operation().name);
    ImGui::SetCursorScreenPos({corner.x, corner.y + ImGui::GetFrameHeight() + c.ui.grid(1)});
    if (!shown->mask && c.place.can_add_mask() &&
        button(c.ui, "view.add_mask", "Add a mask",
               {.width = wide, .help = "A segmentation of the vessel, made on this image"}))
        c.place.ask_for_mask();
}

}  // namespace vesselbench
