#include "workbench/window/features/openings/end_markers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "gpu/role_colours.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/drawing/card.h"
#include "workbench/window/drawing/region_lines.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr float kBadge = 0.75F;       ///< radius [em]
constexpr float kMarkerReach = 0.9F;  ///< a cursor so near to a marker is over it [em]
constexpr float kAbove = 1.9F;        ///< a marker is so far above its end, where handles are [em]
constexpr float kCardWidth = 27;      ///< [em]
constexpr int kDiscPoints = 40;

ImVec2 corner_of(const ViewPixel& at) {
    return {static_cast<float>(at.x()), static_cast<float>(at.y())};
}

/// True while clicks are for ends. Keys may have closed the form in this frame.
bool is_active(const PanelContext& c) {
    const auto& form = c.core.form();
    return form && has_field(*form, Meaning::Planes) &&
           !c.core.get<OpeningsFeature>().openings().rows().empty() && c.core.armed().empty() &&
           c.core.view.tool == ClickTool::None;
}

/// Of all ends, in the order of their rows: those in doubt choose their place first.
std::vector<std::optional<ViewPixel>> marker_places(const Ui& ui, const PixelView& screen,
                                                    const std::vector<EndRow>& rows) {
    std::vector<std::optional<ViewPixel>> ends;
    for (const EndRow& row : rows) ends.push_back(screen.place(row.place));
    return marks_apart(screen, ends, kAbove * ui.em, 2.2 * kBadge * ui.em);
}

Paint paint_of(ShownRole role) {
    const PixelColour colour = pixel_colour(role_colour(role));
    const std::uint32_t red = colour[0], green = colour[1], blue = colour[2];
    return paint(red << 16U | green << 8U | blue);
}

bool is_lit(const OpeningsModel& openings, const EndRow& row) {
    return openings.selected() == row.number || openings.pointed() == row.number;
}

/// A planned cut as a disc of its section's area.
void draw_disc(const Ui& ui, const PixelView& screen, const EndRow& row, bool lit) {
    if (!row.cut) return;
    const OpeningPlace& place = row.cut->place;
    const double diameter = place.diameter > 0.0 ? place.diameter : row.diameter;
    std::vector<ImVec2> outline;
    for (const Vec3& point :
         circle_points(place.plane.point, place.plane.normal, diameter / 2, kDiscPoints)) {
        const auto at = screen.place(point);
        if (!at) return;
        outline.push_back(corner_of(*at));
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const Paint colour = end_colour(ui.theme, row);
    const auto count = static_cast<int>(outline.size());
    draw.AddConvexPolyFilled(outline.data(), count, faded(colour, lit ? 0.55 : 0.3));
    draw.AddPolyline(outline.data(), count, colour, ImDrawFlags_Closed,
                     ui.em * (lit ? 0.2F : 0.12F));
}

void draw_marker(PanelContext& c, const PixelView& screen, const EndRow& row,
                 const std::optional<ViewPixel>& at) {
    const auto end = screen.place(row.place);
    if (!at || !end) return;
    const bool lit = is_lit(c.core.get<OpeningsFeature>().openings(), row);
    ImGui::GetWindowDrawList()->AddLine(corner_of(*at), corner_of(*end),
                                        end_colour(c.ui.theme, row), c.ui.em * 0.12F);
    draw_end_badge(c.ui, *at, row, lit);
    const float radius = kBadge * c.ui.em;
    const ImVec2 middle = corner_of(*at);
    c.ui.item("view.end." + std::to_string(row.number),
              ScreenRect{middle.x - radius, middle.y - radius, 2 * radius, 2 * radius});
}

struct WishButton {
    EndWish wish;
    bool enabled = true;
    const char* help = "";
};

/// What can be wanted of an end. An inlet becomes an outlet when another one is chosen.
std::vector<WishButton> buttons_of(const EndRow& row) {
    std::vector<WishButton> buttons = {
        {EndWish::Inlet, true, "The blood enters here, and nowhere else"},
        {EndWish::Outlet, row.wish != EndWish::Inlet, "Choose another end as the inlet"},
        {EndWish::Closed, true, "Not opened: it stays as it is, or is closed as wall"}};
    if (row.removable || row.wish == EndWish::Removed)
        buttons.push_back({EndWish::Removed, true, "Its branch is cut off at the root"});
    return buttons;
}

}  // namespace

Paint end_colour(const Theme& theme, const EndRow& row) {
    switch (row.wish) {
        case EndWish::Inlet:
            return paint_of(ShownRole::Inlet);
        case EndWish::Outlet:
            return paint_of(ShownRole::Outlet);
        case EndWish::Removed:
            return theme.danger;
        case EndWish::Closed:
            break;
    }
    return paint_of(row.sac ? ShownRole::Sac : ShownRole::Closed);
}

void draw_end_badge(const Ui& ui, const ViewPixel& at, const EndRow& row, bool lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 middle = corner_of(at);
    const float radius = kBadge * ui.em * (lit ? 1.15F : 1.0F);
    const Paint rim = row.doubtful ? ui.theme.warning
                      : lit        ? paint(0xFFFFFF)
                                   : paint(0x101418, 200);
    draw.AddCircleFilled(middle, radius + ui.em * (row.doubtful || lit ? 0.2F : 0.1F), rim);
    draw.AddCircleFilled(middle, radius, end_colour(ui.theme, row));
    const ImFont* font = ui.fonts.small;
    const std::string number = std::to_string(row.number);
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, number.c_str());
    draw.AddText(font, font->FontSize, {middle.x - size.x / 2, middle.y - size.y / 2},
                 paint(0xFFFFFF), number.c_str());
}

std::string end_text(const EndRow& row) {
    return "End " + std::to_string(row.number) + ": diameter " + readable_number(row.diameter) +
           " mm, " + formatted(100.0 * row.share, "%.0f %%") + " of the flow";
}

bool EndMarkers::update(PanelContext& c, const PixelView& screen, bool over, bool clicked) {
    hot_.reset();
    if (!over || !is_active(c)) return false;
    const std::vector<EndRow>& rows = c.core.get<OpeningsFeature>().openings().rows();
    const auto nearest =
        nearest_to(mouse_pixel(), marker_places(c.ui, screen, rows), kMarkerReach * c.ui.em);
    if (!nearest) return false;
    const EndRow row = rows[*nearest];
    hot_ = row.number;
    c.core.get<OpeningsFeature>().openings().point_at(row.number);
    if (!clicked) return false;
    c.core.get<OpeningsFeature>().openings().select(row.number);
    c.core.fill_form(c.core.get<OpeningsFeature>().openings().wish_texts(*c.core.form(), row.number,
                                                                         next_wish(row)));
    return true;
}

void EndMarkers::draw(PanelContext& c, const PixelView& screen) const {
    const OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    const std::vector<EndRow>& rows = openings.rows();
    for (const EndRow& row : rows) draw_disc(c.ui, screen, row, is_lit(openings, row));
    const auto places = marker_places(c.ui, screen, rows);
    for (const bool lit : {false, true})  // over the others
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (is_lit(openings, rows[i]) == lit) draw_marker(c, screen, rows[i], places[i]);
    const EndRow* hot = hot_ ? openings.row(*hot_) : nullptr;
    if (hot == nullptr) return;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    tooltip(c.ui, end_text(*hot) + "\n" + to_string(hot->wish) +
                      (hot->why.empty() ? "" : ": " + hot->why));
}

void EndMarkers::draw_card(PanelContext& c, const PixelView& screen) const {
    OpeningsModel& openings = c.core.get<OpeningsFeature>().openings();
    const EndRow* chosen = openings.selected() ? openings.row(*openings.selected()) : nullptr;
    if (chosen == nullptr || !is_active(c) || c.core.before_drag()) return;
    const EndRow row = *chosen;
    const auto at = marker_places(
        c.ui, screen, openings.rows())[static_cast<std::size_t>(chosen - openings.rows().data())];
    if (!at) return;
    const float pad = c.ui.grid(1), line = ImGui::GetFrameHeight();
    const ScreenRect card = vesselbench::draw_card(c.ui, rect_of(screen), *at, kCardWidth, 2);
    ImGui::AlignTextToFramePadding();
    clipped_text(c.ui, end_text(row), c.ui.theme.text, card.width - 3 * pad - line);
    ImGui::SetCursorScreenPos({card.x + card.width - pad - line, card.y + pad});
    if (icon_button(c.ui, "card.close", icons::kClose, "Close")) return openings.select({});
    const std::vector<WishButton> buttons = buttons_of(row);
    const auto count = static_cast<float>(buttons.size());
    const float wide = (card.width - (count + 1) * pad) / count;
    ImGui::SetCursorScreenPos({card.x + pad, card.y + 2 * pad + line});
    for (const auto& [wish, enabled, help] : buttons) {
        if (button(c.ui, "card." + to_string(wish), to_string(wish),
                   {.primary = row.wish == wish, .enabled = enabled, .width = wide, .help = help}))
            c.core.fill_form(openings.wish_texts(*c.core.form(), row.number, wish));
        ImGui::SameLine(0, pad);
    }
}

}  // namespace vesselbench
