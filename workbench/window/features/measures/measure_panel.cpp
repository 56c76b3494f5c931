#include "workbench/window/features/measures/measure_panel.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/report/measure_table.h"
#include "workbench/window/case/local_time.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kName = 11.0F;  ///< [em]
constexpr float kTime = 8.5F;   ///< [em]

/// "surface, Smooth", "axial slice"
std::string made_on(const PanelContext& c, const KeptMeasure& measure) {
    std::string words = to_string(measure.on);
    std::ranges::replace(words, '-', ' ');
    if (measure.on != MeasuredOn::Surface && measure.on != MeasuredOn::Preview) return words;
    const auto& rows = c.core.history().rows;
    const auto row = std::ranges::find(rows, measure.state, &HistoryRow::state);
    return row == rows.end() ? words : words + ", " + readable(row->title);
}

/// \return true if the measure is to be removed
bool draw_tools(PanelContext& c, const KeptMeasure& measure, const std::string& number) {
    if (icon_button(c.ui, "measures.look." + number, icons::kTarget,
                    "Show the place in the view and in the slices"))
        c.core.look_at(middle_of(measure));
    ImGui::SameLine(0, c.ui.grid(0.5F));
    return icon_button(c.ui, "measures.remove." + number, icons::kDelete,
                       "Remove this measurement");
}

/// The time gives way first, then where it was made, then figures; the name is kept.
/// \return true if the measure is to be removed
bool draw_row(PanelContext& c, std::size_t i) {
    const Ui& ui = c.ui;
    const KeptMeasure measure = c.core.get<MeasuresFeature>().measures().all()[i];
    const std::string number = std::to_string(i);
    const float gap = ui.grid(1), right = ImGui::GetWindowWidth() - ui.grid(3);
    const float tools = right - 2 * ImGui::GetFrameHeight() - ui.grid(0.5F);
    const float figures = ui.em * kName + 2 * gap, room = tools - figures;
    const float time = room > ui.em * 3 * kTime ? ui.em * kTime : 0;
    const float on = room - time > ui.em * 2 * kTime ? (room - time) * 0.4F : 0;
    ImGui::SetCursorPosX(gap);
    std::string name = measure.name;
    if (text_field(c.ui, "measures.name." + number, name, {.hint = "name", .width = ui.em * kName}))
        c.core.get<MeasuresFeature>().measures().rename(i, name);
    const auto cell = [&](float from, float wide, const std::string& words, Paint colour) {
        if (wide <= gap) return;
        ImGui::SameLine(from);
        ImGui::AlignTextToFramePadding();
        clipped_text(ui, words, colour, wide - gap);
    };
    cell(figures, room - on - time, measure_text(measure), ui.theme.text);
    cell(tools - time - on, on, made_on(c, measure), ui.theme.muted);
    cell(tools - time, time, local_time(measure.time, "%Y-%m-%d %H:%M"), ui.theme.muted);
    ImGui::SameLine(tools);
    return draw_tools(c, measure, number);
}

void draw_export(PanelContext& c) {
    ImGui::SetCursorPosX(c.ui.grid(1));
    if (button(c.ui, "measures.export", "Export as CSV",
               {.icon = icons::kExport, .enabled = c.core.document.can(RequestKind::Output)}))
        c.core.ask(FileQuestion::Measures);
}

}  // namespace

void draw_measure_table(PanelContext& c) {
    const MeasureList& measures = c.core.get<MeasuresFeature>().measures();
    space(c.ui, 0.5F);
    if (!measures.not_stored().empty())
        wrapped(c.ui, "Changes are lost when the project is closed: " + measures.not_stored(),
                c.ui.theme.warning);
    if (measures.all().empty())
        return wrapped(c.ui,
                       "No measurements yet. M measures distances, on the model and in slices; D "
                       "measures diameters.",
                       c.ui.theme.muted);
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < measures.all().size(); ++i)
        if (draw_row(c, i)) removed = i;
    draw_export(c);
    if (removed) c.core.get<MeasuresFeature>().measures().remove(*removed);
}

}  // namespace vesselbench
