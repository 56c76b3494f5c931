#include "workbench/window/features/history/history_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/history/history_columns.h"
#include "workbench/window/features/history/thumbnail_drawing.h"
#include "workbench/window/features/history/thumbnails.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr int kMostColumns = 8;
constexpr float kLeastWords = 6.0F;  ///< room below which arguments are left out [em]

float row_height(const Ui& ui) {
    return ui.em * 2.2F;
}

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
    float picture, title, change, author, time, end, tools;
};

/// Of a thumbnail in a row; its height is the row's.
float picture_width(float height) {
    return height * kThumbnailWidth / kThumbnailHeight;
}

Columns columns_of(const Ui& ui, const HistoryTree& tree, float width) {
    const float graph =
        ui.grid(3.5F) + static_cast<float>(std::min(tree.columns, kMostColumns)) * ui.em;
    const float side = ImGui::GetFrameHeight();
    Columns columns{.picture = graph, .tools = width - ui.grid(0.5F) - 2 * side};
    const bool folds =
        std::ranges::any_of(tree.rows, [](const auto& row) { return row.fold != 0; });
    columns.title = graph + picture_width(row_height(ui)) + ui.grid(1);
    columns.end = std::max(columns.title, columns.tools - ui.grid(0.5F) - (folds ? side : 0));
    const HistoryColumns shares = history_columns((columns.end - columns.title) / ui.em);
    columns.change = columns.title + shares.name * ui.em;
    columns.author = columns.change + shares.change * ui.em;
    columns.time = columns.author + shares.author * ui.em;
    return columns;
}

/// Nothing in a column that is left out.
void cell(const Ui& ui, float x, float until, float y, const std::string& words, Paint colour) {
    if (until <= x) return;
    const ImVec2 window = ImGui::GetWindowPos();
    const std::string shown = fitted(words, until - x - ui.grid(1.5F));
    ImGui::GetWindowDrawList()->AddText({window.x + x, y}, colour, shown.c_str());
}

std::string first_line(const std::string& words) {
    return words.substr(0, words.find('\n'));
}

/// "Smooth (printing)", "12 strokes of Brush smooth"
std::string row_title(const HistoryRow& state) {
    const std::string title =
        state.strokes > 1 ? counted(state.strokes, "stroke") + " of " + readable(state.brush)
                          : readable(state.title);
    return state.variant.empty() ? title : title + " (" + state.variant + ")";
}

void draw_cells(const Ui& ui, const HistoryRow& state, const Columns& columns, float y) {
    const Paint strong = state.on_path ? ui.theme.text : ui.theme.muted;
    ImGui::PushFont(state.current ? ui.fonts.medium : ui.fonts.regular);
    const std::string title = row_title(state);
    cell(ui, columns.title, columns.change, y, title, strong);
    const float wide = ImGui::CalcTextSize(title.c_str()).x;
    ImGui::PopFont();
    const std::string words =
        state.note.empty() ? (state.strokes > 1 ? "" : state.arguments)
                           : "\u201C" + first_line(state.note) + "\u201D  " + state.arguments;
    const float left = columns.title + wide + ui.grid(1);
    const float until = state.change.empty() ? columns.author : columns.change;
    if (until - left > ui.em * kLeastWords) cell(ui, left, until, y, words, ui.theme.muted);
    cell(ui, columns.change, columns.author, y, state.change, ui.theme.muted);
    cell(ui, columns.author, columns.time, y, state.author, ui.theme.muted);
    cell(ui, columns.time, columns.end, y, state.time, ui.theme.muted);
}

ImTextureID image_of(unsigned texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t{texture});
}

/// Registers the visible part of a rectangle.
void register_row(Ui& ui, const std::string& name, ImVec2 from, ImVec2 to) {
    const ImVec2 window = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const float top = std::max(from.y, window.y), bottom = std::min(to.y, window.y + size.y);
    if (bottom > top) ui.item(name, ScreenRect{from.x, top, to.x - from.x, bottom - top});
}

/// A small picture of the state, if there is one.
void draw_picture(PanelContext& c, const HistoryRow& state, ImVec2 from, float height) {
    const ImVec2 to{from.x + picture_width(height), from.y + height};
    const unsigned texture = c.thumbnails.of_state(state.state);
    if (texture != 0) ImGui::GetWindowDrawList()->AddImage(image_of(texture), from, to);
}

void draw_help(PanelContext& c, const HistoryRow& state) {
    const float wide = c.ui.em * 17;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.ui.grid(1.25F), c.ui.grid(1)});
    ImGui::BeginTooltip();
    if (const unsigned texture = c.thumbnails.of_state(state.state); texture != 0)
        ImGui::Image(image_of(texture), {wide, wide * kThumbnailHeight / kThumbnailWidth});
    ImGui::PushTextWrapPos(c.ui.em * 24);
    const auto line = [&](const std::string& words, Paint colour) {
        text(c.ui, broken(words, c.ui.em * 24 - ImGui::GetCursorPosX()), colour);
    };
    line(row_title(state) + (state.strokes > 1 ? "" : " " + state.arguments), c.ui.theme.text);
    if (!state.note.empty()) line("\u201C" + state.note + "\u201D", c.ui.theme.text);
    if (!state.change.empty()) line(state.change, c.ui.theme.muted);
    if (!state.time.empty()) line(state.time + "  " + state.author, c.ui.theme.muted);
    if (!state.current) line("Click to go to this state; nothing is lost.", c.ui.theme.muted);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

/// An icon that is pale until the mouse is over it, or it is pressed.
bool quiet_icon(PanelContext& c, const std::string& name, const char* icon, const std::string& help,
                bool pressed) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFrameHeight();
    const bool lit = pressed || ImGui::IsMouseHoveringRect(from, {from.x + side, from.y + side});
    ImGui::PushStyleColor(ImGuiCol_Text, lit ? c.ui.theme.text : faded(c.ui.theme.muted, 0.6));
    const bool clicked = icon_button(c.ui, name, icon, help, true, pressed);
    ImGui::PopStyleColor();
    return clicked;
}

/// Lists strokes one by one, or in one row.
void draw_fold(PanelContext& c, const HistoryRow& state) {
    const bool is_folded = state.strokes > 1;
    if (!quiet_icon(c, "history.fold." + std::to_string(state.fold),
                    is_folded ? icons::kRight : icons::kDown,
                    is_folded ? "List the strokes one by one" : "Show the strokes in one row",
                    false))
        return;
    if (is_folded)
        c.shown.unfolded_states.insert(state.fold);
    else
        c.shown.unfolded_states.erase(state.fold);
}

/// The buttons at the row's end.
void draw_tools(PanelContext& c, const HistoryRow& state, ImVec2 at) {
    const std::string id = std::to_string(state.state);
    ImGui::SetCursorScreenPos({at.x - ImGui::GetFrameHeight(), at.y});
    if (state.fold != 0) draw_fold(c, state);
    ImGui::SetCursorScreenPos(at);
    if (state.edit.id != 0 && state.strokes == 1 &&
        quiet_icon(c, "history.note." + id, icons::kNote,
                   state.note.empty() ? "Add a note to this edit" : state.note,
                   !state.note.empty()))
        c.shown.note = NoteInProgress{state.edit, readable(state.title), state.note};
    if (state.current) return;
    const auto& comparison = c.core.get<CompareFeature>().comparison();
    const bool compared = comparison && comparison->reference() == Reference(state.state);
    ImGui::SetCursorScreenPos({at.x + ImGui::GetFrameHeight(), at.y});
    if (quiet_icon(c, "history.compare." + id, icons::kCompare,
                   compared ? "End the comparison" : "Compare this state with the shown one",
                   compared))
        c.core.get<CompareFeature>().compare(state.state);
}

void draw_row(PanelContext& c, const HistoryRow& state, const Columns& columns, float height) {
    const std::string name = "history." + std::to_string(state.state);
    const bool clicked =
        ImGui::InvisibleButton(name.c_str(), {ImGui::GetContentRegionAvail().x, height});
    const bool seen = ImGui::IsItemVisible(), hovered = ImGui::IsItemHovered();
    ImGui::SetItemAllowOverlap();
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    // A click on its middle must not hit its buttons.
    register_row(c.ui, name, from, {from.x + columns.end, to.y});
    if (!seen) return;
    if (state.current || hovered)
        ImGui::GetWindowDrawList()->AddRectFilled(
            from, to, state.current ? c.ui.theme.selected : c.ui.theme.hover);
    draw_picture(c, state, {from.x + columns.picture, from.y}, height);
    draw_cells(c.ui, state, columns, from.y + (height - c.ui.em) / 2);
    const ImVec2 next = ImGui::GetCursorPos();
    if (hovered && ImGui::GetMousePos().x < from.x + columns.end) draw_help(c, state);
    const float side = ImGui::GetFrameHeight();
    draw_tools(c, state, {from.x + columns.tools, from.y + (height - side) / 2});
    ImGui::SetCursorPos(next);
    if (clicked && !state.current && c.core.document.can(RequestKind::History))
        c.core.document.jump(state.state);
}

/// The nodes and lines that reach into the visible part.
void draw_graph(const Ui& ui, const HistoryTree& tree, const ImVec2& corner, float height) {
    const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowHeight();
    const auto first = static_cast<int>(std::floor((top - corner.y) / height));
    const auto last = static_cast<int>(std::ceil((bottom - corner.y) / height));
    const int count = static_cast<int>(tree.rows.size());
    for (int i = std::max(first, 0); i < count; ++i)
        if (i <= last || (tree.rows[i].parent_row >= 0 && tree.rows[i].parent_row <= last))
            draw_node(ui, tree.rows, i, corner, height);
}

/// Once for each state and size of the list, however many frames it takes until the row is seen.
void show_current(const HistoryTree& tree, float top, float height) {
    int& seen = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("seen"), -1);
    float& seen_room = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID("seen room"), 0.0F);
    const float from = ImGui::GetWindowPos().y, room = ImGui::GetWindowHeight();
    const bool resized = std::exchange(seen_room, room) != room;
    const auto current = std::ranges::find(tree.rows, true, &HistoryRow::current);
    if (current == tree.rows.end() || (seen == current->state && !resized)) return;
    if (resized) seen = -1;
    const float row = top + static_cast<float>(current - tree.rows.begin()) * height;
    if (row >= from && row + height <= from + room)
        seen = static_cast<int>(current->state);
    else
        ImGui::SetScrollY(std::max(0.0F, row - top + (height - room) / 2));
}

}  // namespace

void draw_history(PanelContext& c) {
    const HistoryTree tree = folded(c.core.history(), c.shown.unfolded_states);
    const float height = row_height(c.ui);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    // The columns stay where they are when the list gets its scroll bar.
    const float width = ImGui::GetWindowWidth() - ImGui::GetStyle().ScrollbarSize;
    const Columns columns = columns_of(c.ui, tree, width);
    const int count = static_cast<int>(tree.rows.size());
    ImGuiListClipper clipper;
    clipper.Begin(count, height);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            draw_row(c, tree.rows[i], columns, height);
    draw_graph(c.ui, tree, corner, height);
    show_current(tree, corner.y, height);
    ImGui::PopStyleVar();
}

}  // namespace vesselbench
