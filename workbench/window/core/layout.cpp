#include "workbench/window/core/layout.h"

#include <algorithm>
#include <cmath>

namespace vesselbench {

namespace {

/// Sizes that a part is kept within [em], as far as the window has room.
struct Limits {
    float least, most;
};

constexpr Limits kRail{9.0F, 40.0F}, kOperation{17.0F, 50.0F}, kBottom{4.5F, 60.0F};
constexpr float kLeastView = 18.0F;  ///< width and height that the view keeps [em]
constexpr float kUsualSlices = 0.52F, kLeastPart = 0.2F;
constexpr float kEnlargedSlice = 0.68F;  ///< of the view's width

/// Size of a panel [pixels].
float size_of(const PanelSize& chosen, float whole, float automatic, const Limits& limits,
              float em) {
    if (chosen.folded) return 0.0F;
    if (!chosen.share) return automatic;
    return std::clamp(static_cast<float>(*chosen.share) * whole, limits.least * em,
                      limits.most * em);
}

/// Two panels share the room that the view between them leaves, in their proportion.
void leave_room(float& first, float& second, float room) {
    const float sum = first + second;
    if (sum <= room || sum <= 0.0F) return;
    first *= std::max(room, 0.0F) / sum;
    second *= std::max(room, 0.0F) / sum;
}

}  // namespace

float border_width(float em) {
    return std::round(0.4F * em);
}

Layout layout_of(float width, float height, float em, const PanelSizes& sizes) {
    const float bar = em * 3.1F, status = em * 2.0F, line = 1.0F, border = border_width(em);
    const float top = bar + line, middle = height - top - status - line;
    float side =
        size_of(sizes[Panel::Rail], width, std::clamp(width * 0.19F, em * 15, em * 19), kRail, em);
    float right = size_of(sizes[Panel::Operation], width,
                          std::clamp(width * 0.25F, em * 19, em * 25), kOperation, em);
    float below = size_of(sizes[Panel::Bottom], height,
                          std::clamp(height * 0.21F, em * 8.5F, em * 17), kBottom, em);
    const float across = width - 2 * border;
    leave_room(side, right, across - std::min(em * kLeastView, 0.35F * across));
    below = std::min(below, std::max(middle - border - std::min(em * 12.0F, 0.5F * middle), 0.0F));
    side = std::round(side);
    right = std::round(right);
    below = std::round(below);
    const float left = side + border, centre = across - side - right;
    Layout layout;
    layout.window = {0, 0, width, height};
    layout.tool_bar = {0, 0, width, bar};
    layout.rail = {0, top, side, middle};
    layout.view = {left, top, centre, middle - below - border};
    layout.bottom = {left, top + middle - below, centre, below};
    layout.operation = {width - right, top, right, middle};
    layout.status = {0, height - status, width, status};
    // A window manager may make the window smaller than its least size.
    for (ScreenRect* rect : {&layout.window, &layout.tool_bar, &layout.view, &layout.status}) {
        rect->width = std::max(rect->width, 1.0F);
        rect->height = std::max(rect->height, 1.0F);
    }
    for (ScreenRect* rect : {&layout.rail, &layout.bottom, &layout.operation}) {
        rect->width = std::max(rect->width, 0.0F);
        rect->height = std::max(rect->height, 0.0F);
    }
    layout.borders = {
        {Panel::Rail, {side, top, border, middle}, 0, width, true},
        {Panel::Operation, {width - right - border, top, border, middle}, width, 0, true},
        {Panel::Bottom,
         {left, top + middle - below - border, centre, border},
         top + middle,
         top + middle - height,
         false}};
    layout.compact = width < em * 62;
    return layout;
}

ViewParts view_parts(const ScreenRect& view, float em, const PanelSizes& sizes, Enlarged enlarged) {
    const float border = border_width(em);
    if (enlarged != Enlarged::None) {
        const float wide = std::round(view.width * kEnlargedSlice);
        return {.model = {view.x + wide + 1, view.y, view.width - wide - 1, view.height},
                .slices = {view.x, view.y, wide, view.height},
                .beside = std::nullopt,
                .border = std::nullopt};
    }
    const double share = std::clamp(sizes[Panel::Slices].share.value_or(kUsualSlices),
                                    static_cast<double>(kLeastPart), 1.0 - kLeastPart);
    const float below = std::round(view.height * static_cast<float>(share));
    const float above = std::max(view.height - below - border, 1.0F);
    const float bottom = view.y + view.height;
    ViewParts parts;
    parts.model = {view.x, view.y, view.width, above};
    parts.slices = {view.x, bottom - below, view.width, below};
    if (sizes.quarters) {
        parts.model.width = std::round(0.5F * (view.width - 1.0F));
        const float left = parts.model.x + parts.model.width + 1.0F;
        parts.beside = ScreenRect{left, view.y, view.x + view.width - left, above};
    }
    parts.border =
        Border{Panel::Slices, {view.x, view.y + above, view.width, border}, bottom, view.y, false};
    return parts;
}

}  // namespace vesselbench
