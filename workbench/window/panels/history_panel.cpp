#include "workbench/window/panels/history_panel.h"

#include <algorithm>

#include <imgui.h>

#include "workbench/window/model/readable.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

constexpr int kMostColumns = 8;

ImVec2 node_at(const Ui& ui, const ImVec2& corner, int column, int row, float height) {
    return {corner.x + ui.grid(1.5F) + static_cast<float>(std::min(column, kMostColumns)) * ui.em,
            corner.y + (static_cast<float>(row) + 0.5F) * height};
}

/// The line from the parent, and the state's dot.
void draw_node(const Ui& ui, const std::vector<HistoryRow>& rows, int i, const ImVec2& corner,
               float height) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const HistoryRow& state = rows[i];
    const Paint colour = state.on_path ? ui.theme.accent : faded(ui.theme.muted, 0.7);
    const ImVec2 here = node_at(ui, corner, state.column, i, height);
    const float thick = ui.em / 8;
    if (state.parent_row >= 0) {
        const ImVec2 parent =
            node_at(ui, corner, rows[state.parent_row].column, state.parent_row, height);
        draw.AddLine({here.x, parent.y + (here.x > parent.x ? 0 : ui.em * 0.3F)}, here, colour,
                     thick);
        if (here.x > parent.x)
            draw.AddLine({parent.x + ui.em * 0.3F, parent.y}, {here.x, parent.y}, colour, thick);
    }
    draw.AddCircleFilled(here, ui.em * (state.current ? 0.36F : 0.25F), colour);
    if (state.current) draw.AddCircle(here, ui.em * 0.5F, colour, 0, thick * 0.7F);
}

struct Columns {
    float title, change, author, time, end;
};

Columns columns_of(const Ui& ui, const HistoryTree& tree, float width) {
    const float graph =
        ui.grid(3.5F) + static_cast<float>(std::min(tree.columns, kMostColumns)) * ui.em;
    const float time = ui.em * 8.5F, author = ui.em * 6;
    Columns columns{.title = graph, .end = width - ui.grid(1)};
    columns.time = columns.end - time;
    columns.author = columns.time - author;
    columns.change = graph + (columns.author - graph) * 0.42F;
    return columns;
}

void cell(const Ui& ui, float x, float until, float y, const std::string& words, Paint colour) {
    const ImVec2 window = ImGui::GetWindowPos();
    const std::string shown = fitted(words, until - x - ui.grid(1.5F));
    ImGui::GetWindowDrawList()->AddText({window.x + x, y}, colour, shown.c_str());
}

void draw_cells(const Ui& ui, const HistoryRow& state, const Columns& columns, float y) {
    const Paint strong = state.on_path ? ui.theme.text : ui.theme.muted;
    ImGui::PushFont(state.current ? ui.fonts.medium : ui.fonts.regular);
    const std::string title = readable(state.title);
    cell(ui, columns.title, columns.change, y, title, strong);
    const float wide = ImGui::CalcTextSize(title.c_str()).x;
    ImGui::PopFont();
    cell(ui, columns.title + wide + ui.grid(1), columns.change, y, state.arguments, ui.theme.muted);
    cell(ui, columns.change, columns.author, y, state.change, ui.theme.muted);
    cell(ui, columns.author, columns.time, y, state.author, ui.theme.muted);
    cell(ui, columns.time, columns.end, y, state.time, ui.theme.muted);
}

void draw_row(PanelContext& c, const HistoryRow& state, const Columns& columns, float height) {
    const std::string name = "history." + std::to_string(state.state);
    const bool clicked =
        ImGui::InvisibleButton(name.c_str(), {ImGui::GetContentRegionAvail().x, height});
    c.ui.item(name);
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    if (state.current || ImGui::IsItemHovered())
        ImGui::GetWindowDrawList()->AddRectFilled(
            from, to, state.current ? c.ui.theme.selected : c.ui.theme.hover);
    draw_cells(c.ui, state, columns, from.y + (height - c.ui.em) / 2);
    if (!state.arguments.empty() || !state.change.empty())
        help_on_hover(c.ui, state.title + " " + state.arguments + "\n" + state.change +
                                "\nClick to go to this state; nothing is lost.");
    if (clicked && !state.current) c.place.document.jump(state.state);
}

void scroll_to_current(int row, float height) {
    const float middle = (static_cast<float>(row) + 0.5F) * height;
    ImGui::SetScrollY(std::max(0.0F, middle - ImGui::GetWindowHeight() / 2));
}

}  // namespace

void draw_history(PanelContext& c) {
    const HistoryTree& tree = c.place.history();
    const float height = c.ui.em * 1.75F;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Columns columns = columns_of(c.ui, tree, ImGui::GetContentRegionAvail().x);
    const int count = static_cast<int>(tree.rows.size());
    for (int i = 0; i < count; ++i) draw_row(c, tree.rows[i], columns, height);
    for (int i = 0; i < count; ++i) draw_node(c.ui, tree.rows, i, corner, height);
    ImGuiStorage& seen = *ImGui::GetStateStorage();
    const ImGuiID key = ImGui::GetID("seen");
    for (int i = 0; i < count; ++i)
        if (tree.rows[i].current && seen.GetInt(key, -1) != tree.rows[i].state) {
            scroll_to_current(i, height);
            seen.SetInt(key, static_cast<int>(tree.rows[i].state));
        }
    ImGui::PopStyleVar();
}

}  // namespace vesselbench
