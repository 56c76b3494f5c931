#include "workbench/window/features/extraction/extraction_panel.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/extraction/extraction_feature.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

/// The values of a histogram along a rectangle.
struct ValueAxis {
    ScreenRect rect;
    double least = 0.0, most = 1.0;

    [[nodiscard]] float x(double value) const {
        const double share = std::clamp((value - least) / (most - least), 0.0, 1.0);
        return rect.x + rect.width * static_cast<float>(share);
    }

    [[nodiscard]] double value(float x) const {
        const double share = std::clamp((x - rect.x) / std::max(rect.width, 1.0F), 0.0F, 1.0F);
        return least + share * (most - least);
    }
};

ImDrawList& draw_list() {
    return *ImGui::GetWindowDrawList();
}

/// By the logarithm: vessels are few among the voxels.
float height_of(std::size_t count, std::size_t largest) {
    return static_cast<float>(std::log1p(static_cast<double>(count)) /
                              std::log1p(static_cast<double>(std::max<std::size_t>(largest, 1))));
}

/// The side of the iso-value on which the vessel lies is filled with the accent.
void draw_columns(const PanelContext& c, const ImageHistogram& histogram, const ValueAxis& axis,
                  std::optional<double> iso, bool below) {
    const std::size_t largest = *std::ranges::max_element(histogram.counts);
    const auto classes = static_cast<double>(histogram.counts.size());
    const float low = axis.rect.y + axis.rect.height;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double width = (axis.most - axis.least) / classes;
        const double from = axis.least + static_cast<double>(i) * width;
        const bool inside = iso && (below ? from + width / 2 <= *iso : from + width / 2 >= *iso);
        const float high = axis.rect.height * 0.96F * height_of(histogram.counts[i], largest);
        draw_list().AddRectFilled(
            {axis.x(from), low - high}, {axis.x(from + width), low},
            inside ? faded(c.ui.theme.accent, 0.8) : faded(c.ui.theme.muted, 0.55));
    }
}

void draw_iso_line(const PanelContext& c, const ValueAxis& axis, double iso) {
    const float x = axis.x(iso), low = axis.rect.y + axis.rect.height;
    draw_list().AddLine({x, axis.rect.y}, {x, low}, c.ui.theme.text, std::max(1.5F, c.ui.em / 8));
    draw_list().AddCircleFilled({x, axis.rect.y}, c.ui.em * 0.32F, c.ui.theme.text);
}

void draw_end(const PanelContext& c, ImVec2 at, float alignment, double value) {
    ImFont* font = c.ui.fonts.small;
    const std::string words = formatted(value, "%.4g");
    const float wide = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str()).x;
    draw_list().AddText(font, font->FontSize, {at.x - alignment * wide, at.y}, c.ui.theme.muted,
                        words.c_str());
}

void draw_value(const PanelContext& c, const OperationForm& form) {
    text(c.ui, "Iso-value", c.ui.theme.text);
    const auto iso = c.core.get<ExtractionFeature>().extraction().iso(form);
    if (!iso) return;
    const std::string value = formatted(*iso, "%.6g");
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x -
                    c.ui.grid(0.5F));
    text(c.ui, value, c.ui.theme.text);
}

/// ImGui's last item sets the iso-value while it is pressed.
void handle_press(PanelContext& c, const ValueAxis& axis) {
    Core& core = c.core;
    if (ImGui::IsItemActivated()) core.get<ExtractionFeature>().begin_sliding();
    if (ImGui::IsItemActive() && core.get<ExtractionFeature>().is_sliding())
        core.get<ExtractionFeature>().slide(axis.value(ImGui::GetIO().MousePos.x));
    if (ImGui::IsItemDeactivated() && core.get<ExtractionFeature>().is_sliding()) core.end_drag();
}

void draw_histogram(PanelContext& c, const OperationForm& form, const ImageHistogram& histogram) {
    const LiveExtraction& extraction = c.core.get<ExtractionFeature>().extraction();
    draw_value(c, form);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float pad = c.ui.grid(1), high = c.ui.em * 8.0F;
    const float wide = ImGui::GetContentRegionAvail().x - 2 * pad;
    const ValueAxis axis{
        {from.x + pad, from.y + c.ui.grid(0.75F), wide, high}, histogram.least, histogram.most};
    draw_list().AddRectFilled({axis.rect.x, axis.rect.y}, {axis.rect.x + wide, axis.rect.y + high},
                              c.ui.theme.field);
    const auto iso = extraction.iso(form);
    draw_columns(c, histogram, axis, iso, extraction.is_below(form));
    if (iso) draw_iso_line(c, axis, *iso);
    const float below = axis.rect.y + high + c.ui.grid(0.25F);
    draw_end(c, {axis.rect.x, below}, 0.0F, axis.least);
    draw_end(c, {axis.rect.x + wide, below}, 1.0F, axis.most);
    ImGui::SetCursorScreenPos({axis.rect.x, axis.rect.y});
    ImGui::InvisibleButton("extraction.histogram", {wide, high});
    c.ui.item("extraction.histogram");
    handle_press(c, axis);
    ImGui::SetCursorScreenPos({from.x, below});
    ImGui::Dummy({1, c.ui.em * 1.3F});
}

/// "3 bodies found, 41,200 triangles shown"
std::string figures_of(const ExtractionModel& model) {
    const Surface& surface = model.state.surface;
    return counted(model.state.bodies, "body", "bodies") + " found, " +
           counted(surface.triangle_count(), "triangle") + " shown";
}

void draw_state(PanelContext& c) {
    const LiveExtraction& extraction = c.core.get<ExtractionFeature>().extraction();
    const auto& model = extraction.shown();
    if (!extraction.problem().empty())
        return wrapped(c.ui, readable_sentence(extraction.problem()), c.ui.theme.warning);
    if (!extraction.follows()) return;
    if (!model) return wrapped(c.ui, "Extracting", c.ui.theme.muted);
    wrapped(c.ui, figures_of(*model) + (model->state.whole ? "." : ", coarse while it changes."),
            c.ui.theme.muted);
}

}  // namespace

void draw_extraction_panel(PanelContext& c, const OperationForm& form) {
    LiveExtraction& extraction = c.core.get<ExtractionFeature>().extraction();
    if (!extraction.can_follow())
        return wrapped(c.ui, "The surface cannot be updated: " + extraction.why_not(),
                       c.ui.theme.warning);
    if (extraction.begins()) c.core.get<ExtractionFeature>().follow(true);
    bool on = extraction.follows();
    if (checkbox(c.ui, "live.follow", "Update the surface as fields change", on))
        c.core.get<ExtractionFeature>().follow(on);
    space(c.ui, 1);
    const auto histogram = extraction.histogram();
    if (histogram && !histogram->counts.empty() && extraction.has_iso())
        draw_histogram(c, form, *histogram);
    else if (histogram)
        wrapped(c.ui, "Labels are extracted: there is no threshold to drag.", c.ui.theme.muted);
    space(c.ui, 0.5F);
    draw_state(c);
}

}  // namespace vesselbench
