#include "workbench/window/features/openings/openings_panel.h"

#include <algorithm>
#include <string>
#include <vector>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/openings/end_markers.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kFateWidth = 5.0F;   ///< of the button that says what becomes of an end [em]
constexpr float kMostHeight = 0.8F;  ///< of the table, as a share of what is left [-]

void fill(PanelContext& c, const std::vector<FieldText>& texts) {
    c.core.fill_form(texts);
}

void wish(PanelContext& c, const EndRow& row, EndWish wished) {
    c.core.get<OpeningsFeature>().openings().select(row.number);
    fill(c,
         c.core.get<OpeningsFeature>().openings().wish_texts(*c.core.form(), row.number, wished));
}

/// With Ctrl beside the inlets that there are.
void make_inlet(PanelContext& c, const EndRow& row) {
    if (!ImGui::GetIO().KeyCtrl) return wish(c, row, EndWish::Inlet);
    c.core.get<OpeningsFeature>().openings().select(row.number);
    fill(c, c.core.get<OpeningsFeature>().openings().inlet_texts(*c.core.form(), row.number));
}

std::string doubt_text(const EndRow& row) {
    return "in doubt: an opening with " + formatted(100.0 * row.odds, "%.0f %%");
}

/// The second line.
std::string reason_of(const EndRow& row) {
    if (row.doubtful) return doubt_text(row);
    if (row.moved) return "cut moved";
    return row.why.empty() ? place_text(row.place) : row.why;
}

std::string help_of(const EndRow& row) {
    std::string help = end_text(row) + ", at " + place_text(row.place);
    if (row.doubtful) help += "\n" + doubt_text(row);
    if (!row.why.empty()) help += "\n" + row.why;
    if (row.is_changed()) help += "\nPlanned: " + to_string(row.planned);
    return help;
}

// --- a row

/// Figures and buttons in one line, the reason below it.
float height_of_row(const Ui& ui) {
    return ImGui::GetFrameHeight() + ui.em * 1.2F + ui.grid(1);
}

float width_of_buttons(const Ui& ui) {
    return kFateWidth * ui.em + ImGui::GetFrameHeight() + ui.grid(1);
}

void draw_texts(const PanelContext& c, const EndRow& row, ImVec2 from, float width) {
    const Ui& ui = c.ui;
    const bool lit = c.core.get<OpeningsFeature>().openings().selected() == row.number;
    const float pad = ui.grid(1), line = ImGui::GetFrameHeight();
    const float first = from.y + pad / 2 + (line - ui.em) / 2, second = from.y + pad / 2 + line;
    draw_end_badge(ui, {from.x + pad + ui.em * 0.7F, from.y + height_of_row(ui) / 2}, row, lit);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float left = from.x + pad + ui.em * 2.0F;
    const std::string size = readable_number(row.diameter) + " mm";
    draw.AddText({left, first}, ui.theme.text, size.c_str());
    const std::string share = formatted(100.0 * row.share, "%.0f %%");
    const float at = left + ui.em * 4.3F, end = from.x + width - width_of_buttons(ui);
    const bool fits = at + ImGui::CalcTextSize(share.c_str()).x < end;
    if (fits) draw.AddText({at, first}, ui.theme.text, share.c_str());
    const std::string reason = (fits ? "" : share + ", ") + reason_of(row);
    ImGui::PushFont(ui.fonts.small);
    draw.AddText({left, second}, row.doubtful ? ui.theme.warning : ui.theme.muted,
                 fitted(reason, width - ui.em * 2.0F - 2 * pad).c_str());
    ImGui::PopFont();
}

void draw_buttons(PanelContext& c, const EndRow& row, ImVec2 from, float width) {
    const float fate = kFateWidth * c.ui.em, pad = c.ui.grid(0.5F);
    const std::string name = "end." + std::to_string(row.number);
    ImGui::SetCursorScreenPos({from.x + width - width_of_buttons(c.ui), from.y + pad});
    if (icon_button(c.ui, name + ".inlet", icons::kWater,
                    "The blood enters here\nCtrl: here as well", true, row.wish == EndWish::Inlet))
        make_inlet(c, row);
    ImGui::SetCursorScreenPos({from.x + width - fate - pad, from.y + pad});
    if (button(c.ui, name + ".fate", to_string(row.wish),
               {.primary = row.is_changed(),
                .width = fate,
                .help = "Click: " + to_string(next_wish(row))}))
        wish(c, row, next_wish(row));
}

void draw_row(PanelContext& c, const EndRow& row) {
    OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x);
    const float height = height_of_row(c.ui);
    const std::string name = "end." + std::to_string(row.number);
    const ImVec2 to{from.x + width, from.y + height};
    if (ImGui::InvisibleButton(name.c_str(), {width, height})) openings.select(row.number);
    ImGui::SetItemAllowOverlap();
    c.ui.item(name);
    const bool over = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(from, to);
    if (over) openings.point_at(row.number);
    if (!over && openings.pointed() == row.number && !ImGui::IsItemVisible())
        ImGui::SetScrollHereY();  // its marker is pointed at
    const float buttons = to.x - width_of_buttons(c.ui);
    if (over && ImGui::GetIO().MousePos.x < buttons) tooltip(c.ui, help_of(row));
    const bool chosen = openings.selected() == row.number;
    if (chosen || openings.pointed() == row.number)
        ImGui::GetWindowDrawList()->AddRectFilled(from, to,
                                                  chosen ? c.ui.theme.selected : c.ui.theme.hover,
                                                  ImGui::GetStyle().FrameRounding);
    draw_texts(c, row, from, width);
    draw_buttons(c, row, from, width);
    ImGui::SetCursorScreenPos({from.x, to.y});
}

// --- the table

void reveal(const Ui& ui, int index) {
    const float height = height_of_row(ui), top = static_cast<float>(index) * height;
    const float least = std::min(top, top + height - ImGui::GetWindowHeight());
    ImGui::SetScrollY(std::clamp(ImGui::GetScrollY(), least, top));
}

/// Chooses the row that is so many rows from the chosen one.
void step(const Ui& ui, OpeningsModel& openings, int rows) {
    const std::vector<EndRow>& all = openings.rows();
    const auto chosen = std::ranges::find_if(
        all, [&](const EndRow& row) { return openings.selected() == row.number; });
    const auto last = static_cast<int>(all.size()) - 1;
    const int at =
        chosen == all.end() ? (rows > 0 ? -1 : 0) : static_cast<int>(chosen - all.begin());
    const int to = std::clamp(at + rows, 0, last);
    openings.select(all[static_cast<std::size_t>(to)].number);
    reveal(ui, to);
}

void handle_keys(PanelContext& c) {
    if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) ||
        ImGui::GetIO().WantTextInput || ImGui::GetIO().KeyCtrl)
        return;
    OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    if (ImGui::IsKeyPressed(keys::kDown)) step(c.ui, openings, 1);
    if (ImGui::IsKeyPressed(keys::kUp)) step(c.ui, openings, -1);
    const EndRow* chosen = openings.selected() ? openings.row(*openings.selected()) : nullptr;
    if (chosen == nullptr) return;
    const EndRow row = *chosen;
    if (ImGui::IsKeyPressed(keys::kSpace, false)) wish(c, row, next_wish(row));
    if (ImGui::IsKeyPressed(keys::kEnter, false)) make_inlet(c, row);
}

void draw_table(PanelContext& c) {
    const std::vector<EndRow> rows = c.core.get<OpeningsFeature>().openings().rows();
    const float height = height_of_row(c.ui);
    const float most = kMostHeight * ImGui::GetWindowHeight();
    ImGui::BeginChild("ends", {0, std::min(static_cast<float>(rows.size()) * height, most)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    for (const EndRow& row : rows) draw_row(c, row);
    ImGui::Dummy({0, 0});
    ImGui::PopStyleVar();
    handle_keys(c);
    ImGui::EndChild();
}

/// What takes wishes back.
void draw_returns(PanelContext& c) {
    OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    const bool any = std::ranges::any_of(
        openings.rows(), [](const EndRow& row) { return row.chosen || row.is_changed(); });
    const EndRow* chosen = openings.selected() ? openings.row(*openings.selected()) : nullptr;
    if (button(c.ui, "ends.plain", "All as planned",
               {.enabled = any, .help = "Discard the choices and the moved cuts"}))
        return fill(c, openings.plain_texts());
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "ends.unmove", "Cut as planned",
               {.enabled = chosen != nullptr && chosen->moved,
                .help = "The cut of the chosen end goes back to where it was planned"}))
        fill(c, openings.move_texts(*c.core.form(), chosen->number, std::nullopt));
}

void draw_state(const PanelContext& c) {
    const OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    if (!openings.problem().empty())
        wrapped(c.ui, openings.problem(), c.ui.theme.danger);
    else if (openings.pending() && openings.rows().empty())
        wrapped(c.ui, "Finding the vessel ends", c.ui.theme.muted);
    else
        wrapped(c.ui, summary_of(openings.rows()) + (openings.pending() ? " ..." : ""),
                c.ui.theme.muted);
}

/// Of a form that opens one end.
void draw_single(PanelContext& c) {
    if (!button(c.ui, "ends.all", "Show all ends",
                {.width = -1, .help = "Open all ends at once instead of the one at Tip"}))
        return;
    std::vector<FieldText> texts;
    for (const char* name :
         {"tip", "distance", "radii", "name", "kind", "planes", "names", "closings"})
        texts.push_back({name, ""});
    fill(c, texts);
}

}  // namespace

void draw_openings_panel(PanelContext& c) {
    if (!c.core.get<OpeningsFeature>().openings().lists_ends()) {
        draw_single(c);
    } else {
        draw_state(c);
        if (!c.core.get<OpeningsFeature>().openings().rows().empty()) {
            draw_table(c);
            draw_returns(c);
        }
    }
    space(c.ui, 1);
}

}  // namespace vesselbench
