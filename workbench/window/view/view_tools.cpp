#include "workbench/window/view/view_tools.h"

#include <algorithm>
#include <string>

#include <imgui.h>

#include "workbench/operations/table.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

/// The buttons in the view's corner.
class Tools {
public:
    Tools(PanelContext& context, const ScreenRect& view, int count)
        : c(context), grid_(tool_grid(context.ui, view, count)) {
        const ScreenRect& plate = grid_.rect;
        ImGui::GetWindowDrawList()->AddRectFilled(
            {plate.x, plate.y}, {plate.x + plate.width, plate.y + plate.height},
            faded(c.ui.theme.panel, 0.9), ImGui::GetStyle().FrameRounding);
    }

    bool button(const std::string& name, const char* icon, const std::string& help,
                bool on = false) {
        const float pad = c.ui.grid(0.5F), step = ImGui::GetFrameHeight() + c.ui.grid(0.25F);
        const int row = drawn_ / grid_.columns, column = drawn_ % grid_.columns;
        ImGui::SetCursorScreenPos({grid_.rect.x + pad + static_cast<float>(column) * step,
                                   grid_.rect.y + pad + static_cast<float>(row) * step});
        ++drawn_;
        return icon_button(c.ui, name, icon, help, true, on);
    }

    /// A button that switches something.
    void toggle(const std::string& name, const char* icon, const std::string& help, bool& on) {
        if (button(name, icon, help, on)) on = !on;
    }

    PanelContext& c;

private:
    ToolGrid grid_;
    int drawn_ = 0;
};

void draw_layer_switches(Tools& tools) {
    Settings& settings = tools.c.place.settings;
    const ShownLayers before = settings.layers;
    tools.toggle("view.edges", icons::kGrid, "Triangle edges", settings.layers.edges);
    tools.toggle("view.flat", icons::kFlat, "Flat shading", settings.layers.flat);
    if (settings.layers != before) settings.save_soon();
}

void draw_colour_switch(Tools& tools) {
    ViewChoice& choice = tools.c.place.view;
    const bool coloured = choice.colouring != ColouringKind::Patches;
    const std::string help = std::string("Colours: ") + colouring_info(choice.last_colouring).label;
    if (tools.button("view.deviation", icons::kPalette, help, coloured))
        choice.choose(coloured ? ColouringKind::Patches : choice.last_colouring);
}

void draw_slice_switch(Tools& tools) {
    ImageSlices& slices = tools.c.place.slices();
    const bool shown = slices.any_in_space();
    if (tools.button("view.slices", icons::kImage, "Planes of the image  Shift+I", shown))
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
    Tools tools(c, view, has_image ? kViewTools : kViewTools - 1);
    asked.frame = tools.button("view.fit", icons::kFit, "Show everything  Home");
    draw_layer_switches(tools);
    tools.toggle("view.transparent", icons::kTransparent, "Transparent", c.place.view.transparent);
    draw_colour_switch(tools);
    asked.switch_perspective =
        tools.button("view.perspective", icons::kPerspective, "Perspective  5", perspective);
    tools.toggle("view.options", icons::kLayers, "Colours, sections, overlays and measurements  V",
                 c.shown.view);
    if (has_image) draw_slice_switch(tools);
    return asked;
}

ScreenRect draw_legend(const PanelContext& c, const ViewScene& scene, ClippedCount& clipped) {
    if (scene.hides_model()) return {};
    const auto legend = legend_of(c, scene, clipped);
    if (!legend) return {};
    ScreenRect place = scene.rect();
    const ScreenRect tools = tool_grid(c.ui, place).rect;
    const bool beside = tools.x + tools.width + kLegendWidth * c.ui.em < place.x + place.width;
    place.y =
        std::max(beside ? place.y : tools.y + tools.height - c.ui.grid(4), c.shown.banners_end);
    const float end = scene.rect().y + scene.rect().height;
    if (place.y + kLegendHeight * c.ui.em > end) return {};
    return draw_colour_legend(c.ui, place, *legend);
}

void draw_empty_view(PanelContext& c, const ViewScene& scene) {
    const ScreenRect& rect = scene.rect();
    const float x = rect.middle_x(), y = rect.middle_y();
    float wide = c.ui.em * 12;
    if (scene.has_content()) {  // the image's planes; beside them, and below buttons without room
        const float gap = c.ui.grid(1.5F);
        const ScreenRect tools = tool_grid(c.ui, rect).rect;
        const bool beside = tools.x + tools.width + wide + 2 * gap < rect.x + rect.width;
        const float below = beside ? 0.0F : tools.height + c.ui.grid(1);
        wide = std::min(wide, rect.width - 2 * gap);
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
