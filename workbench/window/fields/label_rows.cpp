#include "workbench/window/fields/label_rows.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <imgui.h>

#include "gpu/colours.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kMostRows = 8.0F;  ///< seen at once

/// The segment's own, else as the slices show it.
Paint colour_of(const LabelRow& row) {
    if (row.colour) {
        const auto [red, green, blue] = *row.colour;
        return paint(std::uint32_t{red} << 16U | std::uint32_t{green} << 8U | blue);
    }
    const PixelColour colour = pixel_colour(category_colour(static_cast<std::size_t>(row.label)));
    const std::uint32_t red = colour[0], green = colour[1], blue = colour[2];
    return paint(red << 16U | green << 8U | blue);
}

void draw_volume(const PanelContext& c, const LabelRow& row) {
    const std::string volume = readable_number(row.volume / 1000.0) + " ml";
    const float wide = ImGui::CalcTextSize(volume.c_str()).x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - wide - c.ui.grid(1));
    text(c.ui, volume, c.ui.theme.muted);
}

void draw_row(PanelContext& c, const FormField& field, const std::vector<LabelRow>& rows,
              const LabelRow& row) {
    const std::string& parameter = field.parameter->name;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = c.ui.em * 0.9F, top = at.y + (ImGui::GetFrameHeight() - side) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side},
                                              colour_of(row), c.ui.em * 0.2F);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side + c.ui.grid(1));
    bool taken = row.taken;
    if (checkbox(c.ui, "field." + parameter + "." + std::to_string(row.label), name_of(row), taken))
        c.core.set_field(parameter, switched_label(rows, row.label));
    draw_volume(c, row);
}

}  // namespace

bool lists_labels(const PanelContext& c, const FormField& field) {
    return field.parameter->meaning == Meaning::Labels && field.error.empty() &&
           !c.core.labels().rows(field).empty();
}

void draw_label_count(PanelContext& c, const FormField& field) {
    const std::vector<LabelRow> rows = c.core.labels().rows(field);
    const auto taken = std::ranges::count(rows, true, &LabelRow::taken);
    ImGui::AlignTextToFramePadding();
    text(c.ui, std::to_string(taken) + " of " + std::to_string(rows.size()),
         field.text.empty() ? c.ui.theme.muted : c.ui.theme.text);
}

void draw_label_rows(PanelContext& c, const FormField& field) {
    const std::vector<LabelRow> rows = c.core.labels().rows(field);
    const float height = ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("labels", {0, std::min(static_cast<float>(rows.size()), kMostRows) * height});
    for (const LabelRow& row : rows) draw_row(c, field, rows, row);
    ImGui::EndChild();
}

}  // namespace vesselbench
