#include "workbench/window/features/slices/slice_pane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/features/measures/measure_drawing.h"
#include "workbench/window/features/measures/measures_feature.h"
#include "workbench/window/features/review/review_marks.h"
#include "workbench/window/features/slices/slices_feature.h"
#include "workbench/window/form/picked_text.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr Paint kBack = paint(0x0B0D10);  ///< behind slices, in both themes
constexpr double kMargin = 0.03;          ///< around a whole slice [-]
constexpr double kZoomPerNotch = 1.15;    ///< of the wheel
constexpr double kWindowDrag = 10.0;      ///< a drag by this changes the window by e [em]
constexpr double kNearSlice = 0.75;       ///< marks so near are shown [slices]
constexpr float kNarrow = 13.0F;          ///< a narrower slice has no scale bar [em]
constexpr float kCrossGap = 0.7F;         ///< around the cross, so that what is there is seen [em]

ImVec2 point(const ViewPixel& place) {
    return {static_cast<float>(place.x()), static_cast<float>(place.y())};
}

/// Fonts and sizes of the window with texts for a dark ground.
Ui overlay_of(const Ui& ui) {
    Ui overlay;
    overlay.theme = dark_theme();
    overlay.fonts = ui.fonts;
    overlay.em = ui.em;
    return overlay;
}

/// Text with a shadow, centred between `at` (0) and its end (1) in both directions.
void shadowed(const Ui& ui, ImVec2 at, ImVec2 anchor, Paint colour, const std::string& words) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont* font = ui.fonts.small;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, words.c_str());
    const ImVec2 from{std::round(at.x - anchor.x * size.x), std::round(at.y - anchor.y * size.y)};
    draw.AddText(font, font->FontSize, {from.x + 1, from.y + 1}, paint(0x000000, 190),
                 words.c_str());
    draw.AddText(font, font->FontSize, from, colour, words.c_str());
}

/// The plane whose slices have their position on an axis.
SlicePlane plane_across(int axis) {
    return *std::ranges::find_if(
        kSlicePlanes, [axis](SlicePlane plane) { return axes_of(plane).normal == axis; });
}

MeasuredOn measured_on(SlicePlane plane) {
    switch (plane) {
        case SlicePlane::Axial:
            return MeasuredOn::AxialSlice;
        case SlicePlane::Coronal:
            return MeasuredOn::CoronalSlice;
        case SlicePlane::Sagittal:
            break;
    }
    return MeasuredOn::SagittalSlice;
}

/// A click does not move the cross: it is for the armed parameter, or measures a distance.
bool takes_clicks(const Core& place) {
    return place.armed_target() ||
           (place.has_click_tool() && place.view.tool == ClickTool::Distance);
}

/// A line with a gap in its middle.
void split_line(ImVec2 from, ImVec2 to, ImVec2 middle, float gap, Paint colour, float width) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool upright = from.x == to.x;
    const ImVec2 reach{upright ? 0 : gap, upright ? gap : 0};
    draw.AddLine(from, {middle.x - reach.x, middle.y - reach.y}, colour, width);
    draw.AddLine({middle.x + reach.x, middle.y + reach.y}, to, colour, width);
}

}  // namespace

ViewCamera slice_camera(const SliceGrid& grid, SlicePlane plane, double position, double aspect) {
    ViewCamera camera{.view = up_of(plane).cross(right_of(plane)), .up = up_of(plane)};
    camera = framed(camera, Bounds{grid.low, grid.high()}, aspect, kMargin);
    camera.centre[axes_of(plane).normal] = position;
    return camera;
}

PixelView SlicePane::screen() const {
    return on_screen(camera_, rect_);
}

Vec3 SlicePane::place_of(const ViewPixel& pixel) const {
    const Eigen::Vector2d ndc = screen().ndc(pixel);
    return unproject(camera_, screen().aspect(), {ndc.x(), ndc.y(), 0.0});
}

/// Follows the slice's position, and the image's size unless the user has moved the view.
void SlicePane::place_camera(const ImageSlices& slices) {
    if (grid_ != slices.grid()) fits_ = true;
    grid_ = slices.grid();
    const double aspect = rect_.width / rect_.height;
    if (fits_) camera_ = slice_camera(grid_, plane_, slices.position(plane_), aspect);
    camera_.centre[axes_of(plane_).normal] = slices.position(plane_);
}

// --- input

void SlicePane::handle_wheel(PanelContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel == 0) return;
    take_keyboard();
    if (io.KeyCtrl) {
        camera_ = zoomed(camera_, screen().aspect(), std::pow(kZoomPerNotch, io.MouseWheel),
                         screen().ndc(mouse_pixel()));
        fits_ = false;
        return;
    }
    turned_ += io.MouseWheel;
    const float slices = std::trunc(turned_);
    turned_ -= slices;
    c.core.get<SlicesFeature>().slices().step(plane_, static_cast<int>(slices));
}

void SlicePane::handle_drag(PanelContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    ImageSlices& slices = c.core.get<SlicesFeature>().slices();
    const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        if (!moved || slices.shows_labels()) return;
        const double unit = kWindowDrag * c.ui.em;
        const GreyWindow grey = slices.grey();
        slices.set_grey({.window = grey.window * std::exp(io.MouseDelta.x / unit),
                         .level = grey.level + grey.window * io.MouseDelta.y / unit});
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || io.KeyShift) {
        if (!moved) return;
        camera_ = panned(camera_, screen().aspect(), Eigen::Vector2d::Zero(),
                         screen().ndc_move({io.MouseDelta.x, io.MouseDelta.y}));
        fits_ = false;
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !takes_clicks(c.core) && pointed_ &&
               !crop_.holds_left()) {
        slices.set_cross(*pointed_);
    }
}

/// A click gives its place to the armed parameter, or measures; a drag does not.
void SlicePane::handle_click(PanelContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    const float reach = kClickReach * c.ui.em;
    const bool still = io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < reach * reach;
    if (!takes_clicks(c.core) || !pointed_ || !still || io.KeyShift ||
        !c.core.get<SlicesFeature>().slices().value_at(*pointed_))
        return;
    if (c.core.has_click_tool())
        return c.core.get<MeasuresFeature>().measures().click(
            *pointed_, c.core.get<MeasuresFeature>().measured_model(measured_on(plane_)));
    const auto target = c.core.armed_target();
    c.core.get<SlicesFeature>().slices().set_cross(*pointed_);
    if (target != PickTarget::Labels) return c.core.pick(*pointed_);
    if (const auto label = c.core.get<SlicesFeature>().slices().label_at(*pointed_))
        c.core.pick_label(*label);
}

Enlarged enlarged_as(SlicePlane plane) {
    switch (plane) {
        case SlicePlane::Axial:
            return Enlarged::Axial;
        case SlicePlane::Coronal:
            return Enlarged::Coronal;
        case SlicePlane::Sagittal:
            return Enlarged::Sagittal;
    }
    return Enlarged::None;
}

void SlicePane::handle_mouse(PanelContext& c) {
    const bool over = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    pointed_.reset();
    const bool released =
        ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (over || active || released) pointed_ = place_of(mouse_pixel());
    if (active) handle_drag(c);
    if (over && released) handle_click(c);
    if (!over) return;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !takes_clicks(c.core))
        switch_enlarged(c.shown, enlarged_as(plane_));
    handle_wheel(c);
    if (c.shown.keys.has(KeyCommand::FrameSlice)) fits_ = true;
    if (takes_clicks(c.core)) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
}

// --- drawing

void SlicePane::draw_picture(const Ui& ui, const PaneSource& source) {
    const int width = std::max(1, static_cast<int>(rect_.width));
    const int height = std::max(1, static_cast<int>(rect_.height));
    const Drawn now{camera_, source.planes.version(), width, height};
    if (drawn_ == now) return;
    if (!target_) target_.emplace(width, height);
    drawn_.reset();
    target_->resize(width, height);
    target_->bind();
    const SceneView view{.camera = camera_,
                         .rectangle = target_->rectangle(),
                         .background = Background{linear(kBack), linear(kBack)}};
    source.renderer.draw(view, source.planes.alone(plane_, std::max(1.0, ui.em / 15.0)));
    texture_ = target_->resolve();
    drawn_ = now;
}

void SlicePane::draw_cross(const Ui& ui, const ImageSlices& slices) const {
    const auto at = screen().place(slices.cross());
    if (!at) return;
    const ImVec2 middle = point(*at);
    const SliceAxes& axes = axes_of(plane_);
    const float width = std::max(1.0F, ui.em / 15), gap = ui.em * kCrossGap;
    split_line({middle.x, rect_.y}, {middle.x, rect_.y + rect_.height}, middle, gap,
               faded(paint_of(plane_across(axes.across)), 0.75), width);
    split_line({rect_.x, middle.y}, {rect_.x + rect_.width, middle.y}, middle, gap,
               faded(paint_of(plane_across(axes.along)), 0.75), width);
}

void SlicePane::draw_texts(PanelContext& c, const Ui& ui) const {
    const float pad = ui.grid(1), right = rect_.x + rect_.width, low = rect_.y + rect_.height;
    const auto letter = [](const Vec3& side) { return std::string(1, patient_letter(side)); };
    const Vec3 across = right_of(plane_), up = up_of(plane_);
    const Paint colour = ui.theme.text;
    // The words at the corners have no letters and no bar beside them where there is no room.
    const bool narrow = rect_.width < ui.em * kNarrow;
    const float line = narrow ? 1.1F * ui.em : 0.0F;
    shadowed(ui, {rect_.x + pad, rect_.middle_y()}, {0, 0.5F}, colour, letter(-across));
    shadowed(ui, {right - pad, rect_.middle_y()}, {1, 0.5F}, colour, letter(across));
    shadowed(ui, {rect_.middle_x(), rect_.y + pad / 2 + line}, {0.5F, 0}, colour, letter(up));
    if (!narrow) shadowed(ui, {rect_.middle_x(), low - pad / 2}, {0.5F, 1}, colour, letter(-up));
    shadowed(ui, {rect_.x + pad, rect_.y + pad}, {0, 0}, paint_of(plane_), axes_of(plane_).name);
    shadowed(ui, {rect_.x + pad, low - pad}, {0, 1}, colour,
             position_text(axes_of(plane_).normal,
                           c.core.get<SlicesFeature>().slices().position(plane_)));
    if (const std::string& problem = c.core.get<SlicesFeature>().slices().problem();
        !problem.empty())
        shadowed(ui, {rect_.middle_x(), rect_.middle_y()}, {0.5F, 0.5F}, colour,
                 fitted("no slice: " + problem, rect_.width - 2 * pad));
    if (!narrow) draw_scale_bar(ui, rect_, camera_);
}

/// Places of the form that lie in this slice.
void SlicePane::draw_marks(const PanelContext& c, const Ui& ui) const {
    if (!c.core.form()) return;
    const int normal = axes_of(plane_).normal;
    const double position = c.core.get<SlicesFeature>().slices().position(plane_);
    for (const NamedPlace& place : places_in(*c.core.form())) {
        const double away = std::abs(place.point[normal] - position);
        const auto at = screen().place(place.point);
        if (at && away <= kNearSlice * grid_.step[normal])
            draw_mark(ui, *at, MarkLook::Picked, place.name);
    }
}

/// Whether the plane is shown in the 3D view.
void SlicePane::draw_switch(PanelContext& c) const {
    const std::string name = std::string("slice.") + axes_of(plane_).key + ".space";
    const float side = ImGui::GetFrameHeight(), gap = c.ui.grid(0.5F);
    const ImVec2 at{rect_.x + rect_.width - side - gap, rect_.y + gap};
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side},
                                              faded(c.ui.theme.panel, 0.9),
                                              ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorScreenPos(at);
    const bool shown = c.core.get<SlicesFeature>().slices().in_space(plane_);
    if (icon_button(c.ui, name, icons::kPreview, "Shown in the 3D view", true, shown))
        c.core.get<SlicesFeature>().slices().show_in_space(plane_, !shown);
}

/// \param rect below the picture
void SlicePane::draw_slider(PanelContext& c, const ScreenRect& rect) const {
    const std::string name = std::string("slice.") + axes_of(plane_).key + ".slider";
    ImageSlices& slices = c.core.get<SlicesFeature>().slices();
    const int normal = axes_of(plane_).normal;
    const double low = grid_.low[normal], extent = grid_.high()[normal] - low;
    const float radius = c.ui.em * 0.36F, left = rect.x + c.ui.grid(1) + radius;
    const float wide = rect.width - 2 * (c.ui.grid(1) + radius), y = rect.middle_y();
    ImGui::SetCursorScreenPos({rect.x, rect.y});
    ImGui::InvisibleButton(name.c_str(), {rect.width, rect.height});
    c.ui.item(name);
    const bool active = ImGui::IsItemActive();
    if (active && wide > 0)
        slices.move(plane_, low + extent * (ImGui::GetIO().MousePos.x - left) / wide);
    const bool lit = active || ImGui::IsItemHovered();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto x = left + wide * static_cast<float>((slices.position(plane_) - low) / extent);
    draw.AddRectFilled({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height},
                       c.ui.theme.panel);
    draw.AddLine({left, y}, {left + wide, y}, c.ui.theme.border, std::max(2.0F, c.ui.em / 6));
    draw.AddCircleFilled({x, y}, radius, lit ? c.ui.theme.accent_hover : c.ui.theme.accent);
}

void SlicePane::draw(PanelContext& c, const PaneSource& source, const ScreenRect& rect) {
    const std::string key = std::string("slice.") + axes_of(plane_).key;
    const float slider = c.ui.em * 1.2F;
    rect_ = {rect.x, rect.y, std::max(1.0F, rect.width), std::max(1.0F, rect.height - slider)};
    begin_frame(c.ui, key, rect, {.back = kBack, .padding = 0, .scrolls = false});
    place_camera(c.core.get<SlicesFeature>().slices());
    ImGui::InvisibleButton((key + ".area").c_str(), {rect_.width, rect_.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    ImGui::SetItemAllowOverlap();
    c.ui.item(key + ".area");
    crop_.update(c, screen());
    handle_mouse(c);
    place_camera(c.core.get<SlicesFeature>().slices());
    if (!source.guard.run([&] { draw_picture(c.ui, source); })) texture_ = 0;
    if (texture_ != 0) draw_texture(texture_, rect_);
    const Ui overlay = overlay_of(c.ui);
    draw_cross(overlay, c.core.get<SlicesFeature>().slices());
    draw_texts(c, overlay);
    draw_marks(c, overlay);
    const int normal = axes_of(plane_).normal;
    draw_measures_in_slice(c, screen(), normal,
                           c.core.get<SlicesFeature>().slices().position(plane_),
                           kNearSlice * grid_.step[normal]);
    draw_review_marks_in_slice(c, screen(),
                               {.item = key,
                                .axis = normal,
                                .position = c.core.get<SlicesFeature>().slices().position(plane_),
                                .away = 0.5 * grid_.step[normal]});
    crop_.draw(c, screen());
    draw_switch(c);
    draw_slider(c, {rect.x, rect.y + rect_.height, rect.width, slider});
    end_frame();
}

}  // namespace vesselbench
