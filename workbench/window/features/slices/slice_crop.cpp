#include "workbench/window/features/slices/slice_crop.h"

#include <vector>

#include <imgui.h>

#include "workbench/window/core/core.h"
#include "workbench/window/features/handles/handles_feature.h"
#include "workbench/window/features/slices/slices_feature.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

/// The place in the slice under the cursor, as a handle that is free to move there.
Handle place_at_cursor(const PixelView& screen) {
    Handle place{.name = "crop.rectangle", .point = screen.camera.centre};
    place.point = dragged_point(place, screen, mouse_pixel());
    return place;
}

void draw_line(const Ui& ui, const PixelView& screen, const RegionLine& line) {
    std::vector<ImVec2> points;
    for (const Vec3& point : line.points)
        if (const auto at = screen.place(point))
            points.emplace_back(static_cast<float>(at->x()), static_cast<float>(at->y()));
    ImGui::GetWindowDrawList()->AddPolyline(
        points.data(), static_cast<int>(points.size()), faded(kRegionPaint, line.faint ? 0.5 : 1.0),
        line.closed ? ImDrawFlags_Closed : ImDrawFlags_None, ui.em * 0.12F);
}

}  // namespace

void SliceCrop::take_shape(const PanelContext& c) {
    shape_ = {};
    const auto& form = c.core.form();
    const auto& offered = c.core.get<HandlesFeature>().offered_box();
    if (!form || !offered) return;
    shape_ = crop_slice_shape(*form, *offered, plane_,
                              c.core.get<SlicesFeature>().slices().position(plane_));
    if (!c.core.armed().empty()) shape_.handles.clear();
}

std::optional<std::size_t> SliceCrop::hot(const PanelContext& c, const PixelView& screen) const {
    const bool pressed = ImGui::IsItemActive() && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (!pressed && (!ImGui::IsItemHovered() || ImGui::IsAnyMouseDown())) return std::nullopt;
    return nearest_handle(shape_.handles, screen, mouse_pixel(), kHandleReach * c.ui.em);
}

void SliceCrop::press(PanelContext& c, const PixelView& screen) {
    if (!hot_) {
        start_ = place_at_cursor(screen);
        state_ = State::Pressed;
        return;
    }
    start_ = shape_.handles[*hot_];
    offset_ = mouse_pixel() - screen.place(start_.point).value_or(mouse_pixel());
    begin(c, State::Handle);
}

void SliceCrop::begin(PanelContext& c, State state) {
    c.core.begin_drag();
    state_ = state;
}

void SliceCrop::follow(PanelContext& c, const PixelView& screen) const {
    const OperationForm& before = *c.core.before_drag();
    const auto& offered = c.core.get<HandlesFeature>().offered_box();
    if (!offered) return;
    if (state_ == State::Rectangle)
        c.core.drag(crop_rectangle_texts(before, *offered, plane_, start_.point,
                                         place_at_cursor(screen).point));
    else if (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0)
        c.core.drag(crop_slice_texts(before, *offered, plane_, *hot_,
                                     dragged_point(start_, screen, mouse_pixel() - offset_)));
}

void SliceCrop::update(PanelContext& c, const PixelView& screen) {
    take_shape(c);
    if (state_ == State::Idle) {
        hot_ = hot(c, screen);
        const bool pressed = ImGui::IsItemActive() && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
        const bool free = c.core.get<HandlesFeature>().offered_box() && c.core.armed().empty();
        if (pressed && free && !ImGui::GetIO().KeyShift) press(c, screen);
        return;
    }
    const float reach = kClickReach * c.ui.em;
    const bool moved =
        ImGui::GetIO().MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] >= reach * reach;
    if (state_ == State::Pressed && moved) begin(c, State::Rectangle);
    if (holds_left() && !c.core.before_drag()) state_ = State::Dropped;
    if (state_ == State::Handle || state_ == State::Rectangle) {
        follow(c, screen);
        take_shape(c);
    }
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    if (state_ == State::Handle || state_ == State::Rectangle) c.core.end_drag();
    state_ = State::Idle;
}

void SliceCrop::draw(PanelContext& c, const PixelView& screen) const {
    for (const RegionLine& line : shape_.lines) draw_line(c.ui, screen, line);
    for (std::size_t i = 0; i < shape_.handles.size(); ++i)
        if (const auto at = screen.place(shape_.handles[i].point))
            draw_handle_mark(c.ui, shape_.handles[i], *at, hot_ == i);
    if (!hot_ || *hot_ >= shape_.handles.size()) return;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    draw_hint(c.ui, rect_of(screen), shape_.handles[*hot_].help);
}

}  // namespace vesselbench
