#include "workbench/window/features/quality/quality_graphs.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/report/quality_graph.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/suggest/suggestion_search.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/features/quality/quality_feature.h"
#include "workbench/window/features/quality/quality_words.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/slider.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr double kMostShown = 1.5;  ///< of a graph's measures, by the strong change [-]

/// What 100 % means, to be followed by its figure.
const char* whole_help(QualityMeasure measure) {
    switch (measure) {
        case QualityMeasure::Curvature:
            return "Mean curvature, summed over the surface; 100 %: ";
        case QualityMeasure::Error:
            return "Mean distance from the surface before; 100 %: ";
        case QualityMeasure::Volume:
            return "Change of volume; 100 %: ";
        case QualityMeasure::Triangles:
            return "Number of triangles; 100 %: ";
        case QualityMeasure::Skewness:
            break;
    }
    return "Mean equiangle skewness; 0 %: all triangles are equilateral, 100 %: ";
}

std::vector<MeasureLook> looks_in(const SensitivityAnalysis& analysis, const OperationForm& form) {
    return looks_of(seen_measures(analysis.scale, form.operation()));
}

Paint colour_of(const Ui& ui, const MeasureLook& look) {
    return paint(ui.theme.dark ? look.on_dark : look.colour);
}

Paint suggestion_colour(const Ui& ui) {
    return ui.theme.dark ? paint(0xC58CFF) : paint(0x7A1FC9);
}

ImDrawList& draw_list() {
    return *ImGui::GetWindowDrawList();
}

ImVec2 pixel_at(double x, double y) {
    return {static_cast<float>(x), static_cast<float>(y)};
}

/// " mm" behind a figure; empty without a unit
std::string unit_of(const QualityCurve& curve) {
    return curve.unit.empty() || curve.unit == "-" ? "" : " " + curve.unit;
}

/// From the top of the rectangle, which is the screen's.
GraphFrame frame_of(const QualityCurve& curve, const ScreenRect& rect) {
    return {rect.x, rect.y, rect.width, rect.height, curve.least, curve.most, kMostShown};
}

/// What the form says now, which may be newer than the curve.
double value_now(const PanelContext& c, const OperationForm& form, const QualityCurve& curve) {
    if (const auto typed = number_of(form, curve.name)) return *typed;
    const auto& model = c.core.get<LiveFeature>().live().model();
    const auto& now = model ? model->state.resolved : Arguments();
    const bool known = now.has(curve.name) && !c.core.get<LiveFeature>().live().outdated();
    return known ? now.real(curve.name) : curve.current;
}

/// What belongs to a filter has no effect until the filter is given, although it is the one that is
/// taken without.
void set_value(PanelContext& c, const OperationForm& form, const std::string& name, double value) {
    const LiveSearch::Answer* answer = c.core.get<QualityFeature>().quality().answer();
    if (!form.field(name).active && answer != nullptr)
        c.core.set_field(form.operation().search.filter_parameter, answer->filter);
    const Parameter& parameter = *form.field(name).parameter;
    c.core.set_field(name, driven_text(parameter, driven_value(parameter, value, 0.0)));
}

/// False for a value of the graph that only stands for the surface as it is.
bool can_set(const OperationForm& form, const QualityCurve& curve, double value) {
    const Parameter& parameter = *form.field(curve.name).parameter;
    return value >= parameter.minimum && value <= parameter.maximum;
}

/// ImGui's last item sets the parameter while it is pressed; the model follows.
void handle_press(PanelContext& c, const OperationForm& form, const QualityCurve& curve,
                  const GraphFrame& axis) {
    if (ImGui::IsItemActivated()) c.core.get<QualityFeature>().begin_setting();
    if (ImGui::IsItemActive() && c.core.get<QualityFeature>().is_setting()) {
        const double value = axis.value(ImGui::GetIO().MousePos.x);
        set_value(c, form, curve.name, rounded_on_axis(value, axis.from, axis.to));
    }
    if (ImGui::IsItemDeactivated() && c.core.get<QualityFeature>().is_setting()) c.core.end_drag();
}

void draw_suggestion(PanelContext& c, const OperationForm& form, const QualityCurve& curve,
                     ImVec2 tip) {
    const float reach = c.ui.em * 0.35F;
    const ImVec2 back = ImGui::GetCursorScreenPos();
    const auto [top, left, right] = suggestion_mark({tip.x, tip.y}, reach, 1.6F * reach);
    draw_list().AddTriangleFilled(pixel_at(top.x, top.y), pixel_at(left.x, left.y),
                                  pixel_at(right.x, right.y), suggestion_colour(c.ui));
    ImGui::SetCursorScreenPos({tip.x - 1.5F * reach, tip.y});
    const std::string name = "quality.suggest." + curve.name;
    const bool settable = can_set(form, curve, curve.suggested);
    if (ImGui::InvisibleButton(name.c_str(), {3 * reach, 1.8F * reach}) && settable)
        set_value(c, form, curve.name, curve.suggested);
    c.ui.item(name);
    help_on_hover(c.ui, settable ? "Suggestion: " + formatted(curve.suggested)
                                 : "Suggestion: leave the surface as it is");
    ImGui::SetCursorScreenPos(back);
}

// --- graphs

void draw_curve(const PanelContext& c, const SensitivityAnalysis& analysis,
                const QualityCurve& curve, const GraphFrame& axis, const MeasureLook& look) {
    const auto share = [&](const CurvePoint& point) {
        return shown_share(analysis, point, look.measure);
    };
    for (const auto& points : graph_lines(curve, axis, share)) {
        if (points.size() < 2) continue;
        std::vector<ImVec2> line;
        for (const auto& [x, y] : points) line.push_back(pixel_at(x, y));
        draw_list().AddPolyline(line.data(), static_cast<int>(line.size()), colour_of(c.ui, look),
                                ImDrawFlags_None, std::max(1.5F, c.ui.em / 8));
    }
}

void label(const PanelContext& c, ImVec2 at, float alignment, const std::string& words) {
    ImFont* font = c.ui.fonts.small;
    const float wide = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str()).x;
    draw_list().AddText(font, font->FontSize, {at.x - alignment * wide, at.y}, c.ui.theme.muted,
                        words.c_str());
}

void draw_grid(const PanelContext& c, const GraphFrame& axis) {
    draw_list().AddRectFilled(pixel_at(axis.left, axis.top), pixel_at(axis.right(), axis.bottom()),
                              c.ui.theme.field);
    for (const double share : {0.0, 0.5, 1.0}) {
        const double y = axis.y(share);
        draw_list().AddLine(pixel_at(axis.left, y), pixel_at(axis.right(), y), c.ui.theme.border);
        label(c, pixel_at(axis.left - c.ui.grid(0.5F), y - c.ui.em * 0.45F), 1.0F,
              formatted(100.0 * share, "%g %%"));
    }
}

/// The values at the ends of an axis, but where the mark of the suggestion is: its value is in the
/// title.
void draw_ends(const PanelContext& c, const QualityCurve& curve, const GraphFrame& axis) {
    const double y = axis.bottom() + c.ui.grid(0.25F), mark = axis.x(curve.suggested);
    const auto end = [&](double x, float alignment, const std::string& words) {
        const ImFont* font = c.ui.fonts.small;
        const double wide = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str()).x;
        const double from = x - alignment * wide, reach = 0.5 * c.ui.em;
        if (mark + reach < from || mark - reach > from + wide)
            label(c, pixel_at(x, y), alignment, words);
    };
    end(axis.left, 0.0F, formatted(axis.from));
    end(axis.right(), 1.0F, formatted(axis.to) + unit_of(curve));
}

/// With the value of now, and the suggestion, which is seen to follow the target.
void draw_title(const PanelContext& c, const QualityCurve& curve, double now) {
    text(c.ui, readable(curve.name), c.ui.theme.text);
    const std::string value = formatted(now, "%.4g");
    const std::string suggested = formatted(curve.suggested, "suggested %.3g");
    const float right = ImGui::GetContentRegionMax().x - c.ui.grid(0.5F);
    const float wide = ImGui::CalcTextSize(value.c_str()).x;
    const float also = ImGui::CalcTextSize(suggested.c_str()).x + c.ui.grid(1.5F);
    const float taken = ImGui::CalcTextSize(readable(curve.name).c_str()).x + c.ui.grid(1);
    if (taken + also + wide < right - ImGui::GetWindowContentRegionMin().x) {
        ImGui::SameLine(right - wide - also);
        text(c.ui, suggested, suggestion_colour(c.ui));
    }
    ImGui::SameLine(right - wide);
    text(c.ui, value, c.ui.theme.text);
}

void draw_value_line(const PanelContext& c, const GraphFrame& axis, double now) {
    const ImVec2 top = pixel_at(axis.x(now), axis.top);
    draw_list().AddLine(top, pixel_at(axis.x(now), axis.bottom()), c.ui.theme.text,
                        std::max(1.0F, c.ui.em / 10));
    draw_list().AddCircleFilled(top, c.ui.em * 0.28F, c.ui.theme.text);
}

/// The figures at the form's value, where no line over the view has them.
void draw_figures(const PanelContext& c, const QualityCurve& curve, const QualityScale& scale,
                  double now) {
    if (c.core.get<LiveFeature>().live().has_form()) return;
    const std::string words = values_at(curve, now, scale);
    wrapped(c.ui, words, c.ui.theme.muted);
    c.ui.item("quality.figures." + curve.name);
}

void draw_graph(PanelContext& c, const OperationForm& form, const SensitivityAnalysis& analysis,
                const QualityCurve& curve) {
    const double now = value_now(c, form, curve);
    draw_title(c, curve, now);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float left = c.ui.em * 3.1F, high = c.ui.em * 5.0F;
    const float wide = ImGui::GetContentRegionAvail().x - left - c.ui.grid(1);
    const GraphFrame axis = frame_of(curve, {from.x + left, from.y + c.ui.grid(0.5F), wide, high});
    draw_grid(c, axis);
    for (const MeasureLook& look : looks_in(analysis, form))
        draw_curve(c, analysis, curve, axis, look);
    draw_value_line(c, axis, now);
    draw_ends(c, curve, axis);
    ImGui::SetCursorScreenPos(pixel_at(axis.left, axis.top));
    ImGui::InvisibleButton(("graph." + curve.name).c_str(), {wide, high});
    c.ui.item("quality.graph." + curve.name);
    if (!ImGui::IsItemActive())
        help_on_hover(c.ui,
                      values_at(curve, axis.value(ImGui::GetIO().MousePos.x), analysis.scale));
    handle_press(c, form, curve, axis);
    draw_suggestion(c, form, curve, pixel_at(axis.x(curve.suggested), axis.bottom()));
    ImGui::SetCursorScreenPos(pixel_at(from.x, axis.bottom()));
    ImGui::Dummy({1, c.ui.em * 1.4F});
    draw_figures(c, curve, analysis.scale, now);
}

void draw_legend(const PanelContext& c, const OperationForm& form,
                 const SensitivityAnalysis& analysis) {
    bool first = true;
    for (const MeasureLook& look : looks_in(analysis, form)) {
        if (!std::exchange(first, false)) ImGui::SameLine(0, c.ui.grid(1.5F));
        small_text(c.ui, measure_name(look.measure), colour_of(c.ui, look));
        help_on_hover(c.ui, whole_help(look.measure) + whole_words(analysis, look.measure));
    }
}

// --- bars

void draw_fields(const QualityCurve& curve, const QualityBar& bar, const GraphFrame& axis,
                 const Ui& ui) {
    for (const BarField& field : bar_fields(curve, bar, axis)) {
        const PixelColour rgb = field.colour.value_or(PixelColour{});
        draw_list().AddRectFilled(
            pixel_at(field.left, axis.top), pixel_at(field.right, axis.bottom()),
            field.colour ? IM_COL32(rgb[0], rgb[1], rgb[2], 255) : ui.theme.field);
    }
    draw_list().AddRect(pixel_at(axis.left, axis.top), pixel_at(axis.right(), axis.bottom()),
                        ui.theme.border);
}

void draw_value_frame(const Ui& ui, const GraphFrame& axis, double now) {
    const double reach = ui.em * 0.25, x = axis.x(now);
    const ImVec2 from = pixel_at(x - reach, axis.top - 2),
                 to = pixel_at(x + reach, axis.bottom() + 2);
    draw_list().AddRect(from, to, paint(0x000000), 0, 0, 3);
    draw_list().AddRect(from, to, paint(0xFFFFFF), 0, 0, 1);
}

void draw_bar(PanelContext& c, const OperationForm& form, const QualityCurve& curve,
              const QualityBar& bar, const std::string& words) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float left = c.ui.em * 5.2F, high = c.ui.em * 0.9F;
    small_text(c.ui, fitted(words, left), c.ui.theme.muted);
    const float wide = ImGui::GetContentRegionAvail().x - left - c.ui.grid(1);
    const GraphFrame axis = frame_of(curve, {from.x + left, from.y, wide, high});
    draw_fields(curve, bar, axis, c.ui);
    draw_value_frame(c.ui, axis, value_now(c, form, curve));
    ImGui::SetCursorScreenPos(pixel_at(axis.left, axis.top));
    const std::string name = curve.name + "." + measure_name(bar.measure);
    ImGui::InvisibleButton(("bar." + name).c_str(), {wide, high});
    c.ui.item("quality.bar." + name);
    handle_press(c, form, curve, axis);
    ImGui::SetCursorScreenPos({from.x, from.y + high + c.ui.grid(0.5F)});
}

void draw_bars(PanelContext& c, const OperationForm& form, const SensitivityAnalysis& analysis,
               BarOrder order) {
    std::string group;
    const auto seen = seen_measures(analysis.scale, form.operation());
    for (const QualityBar& bar : quality_bars(analysis, order)) {
        if (std::ranges::count(seen, bar.measure) == 0) continue;
        const QualityCurve& curve = analysis.curves[bar.curve];
        const bool by_parameter = order == BarOrder::Parameter;
        const std::string own =
            by_parameter ? readable(curve.name) : readable_sentence(measure_name(bar.measure));
        if (own != group) {
            if (!group.empty()) space(c.ui, 0.75F);
            if (by_parameter)
                draw_title(c, curve, value_now(c, form, curve));
            else
                text(c.ui, own, c.ui.theme.text);
        }
        group = own;
        draw_bar(c, form, curve, bar,
                 by_parameter ? measure_name(bar.measure) : readable(curve.name));
    }
    small_text(c.ui, "bright: better; plain: cannot be combined with the other values",
               c.ui.theme.muted);
}

// --- suggestions

void draw_target(PanelContext& c, const OperationForm& form) {
    double& tau = c.core.get<QualityFeature>().quality().tau;
    const bool counts = counts_triangles(form.operation().search);
    slider(c.ui, "quality.tau", tau,
           {.text = formatted(tau, counts ? "Target reduction %.2f" : "Target smoothness %.2f"),
            .help = counts ? "0: as accurate as can be, 1: as few triangles as can be"
                           : "0: as accurate as can be, 1: as smooth as can be"});
    constexpr std::array kNames = {"little", "medium", "strong"};
    const float wide = (ImGui::GetContentRegionAvail().x - 2 * c.ui.grid(1)) / 3;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, c.ui.grid(1));
        if (button(c.ui, std::string("quality.") + kNames[i], readable(kNames[i]),
                   {.primary = tau == kPresetTaus[i],
                    .width = wide,
                    .help = formatted(kPresetTaus[i], "Aims the suggestions at a target of %g")}))
            tau = kPresetTaus[i];
    }
}

void draw_best(PanelContext& c, const OperationForm& form) {
    const LiveSearch::Answer* const answer = c.core.get<QualityFeature>().quality().answer();
    const bool found = answer != nullptr && answer->best;
    const bool known = found && !answer->leave_as_is;
    if (button(c.ui, "quality.best", "Use the best overall",
               {.enabled = known, .width = -1, .help = "Fill in all of these values"})) {
        const Arguments best = *answer->best;
        c.core.get<LiveFeature>().live().follow(true);
        for (const auto& [name, value] : best.values()) set_value(c, form, name, best.real(name));
    }
    std::string words = "Searching";
    if (known) words = suggestion_words(*answer->best, answer->analysis);
    if (found && !known) words = "Leave the surface as it is: all results score worse";
    wrapped(c.ui, found && !answer->complete ? "So far: " + words : words, c.ui.theme.muted);
}

void draw_view_choice(PanelContext& c) {
    const std::vector<std::string> options = {"Graphs", "Bars by parameter", "Bars by measure"};
    std::string chosen = options[static_cast<std::size_t>(c.shown.quality)];
    if (choice(c.ui, "quality.view", options, chosen))
        c.shown.quality =
            static_cast<QualityView>(std::ranges::find(options, chosen) - options.begin());
}

void draw_analysis(PanelContext& c, const OperationForm& form,
                   const SensitivityAnalysis& analysis) {
    if (c.shown.quality == QualityView::Graphs) {
        draw_legend(c, form, analysis);
        space(c.ui, 0.5F);
        for (const QualityCurve& curve : analysis.curves) draw_graph(c, form, analysis, curve);
    } else {
        draw_bars(c, form, analysis,
                  c.shown.quality == QualityView::BarsByMeasure ? BarOrder::Measure
                                                                : BarOrder::Parameter);
    }
}

}  // namespace

void draw_quality(PanelContext& c, const OperationForm& form) {
    QualityAnalysis& quality = c.core.get<QualityFeature>().quality();
    quality.want();
    group_heading(c.ui, "Suggestions");
    space(c.ui, 0.5F);
    draw_target(c, form);
    draw_best(c, form);
    space(c.ui, 1);
    group_heading(c.ui, quality.pending() ? "Quality, being refined" : "Quality");
    space(c.ui, 0.5F);
    draw_view_choice(c);
    if (!quality.problem().empty())
        return wrapped(c.ui, readable_sentence(quality.problem()), c.ui.theme.warning);
    if (quality.answer() == nullptr) return wrapped(c.ui, "Measuring", c.ui.theme.muted);
    // Setting a value changes what is asked, but not this answer.
    draw_analysis(c, form, quality.answer()->analysis);
}

}  // namespace vesselbench
