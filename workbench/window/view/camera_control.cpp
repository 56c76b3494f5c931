#include "workbench/window/view/camera_control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <imgui.h>

#include "workbench/window/core/shown.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

constexpr double kTurnPerHeight = 3.5;   ///< a drag over the view's height turns by this [rad]
constexpr double kZoomPerNotch = 1.15;   ///< of the wheel
constexpr double kClipPerNotch = 0.02;   ///< of the way through the model [-]
constexpr double kFlightPerNotch = 0.5;  ///< [local radii]
constexpr double kLookHeight = 8.0;      ///< around a place that is looked at [mm]
constexpr double kFlightTime = 0.5;      ///< to a place that is looked at [s]
constexpr double kLongestStep = 0.05;    ///< of a flight: the frame before it may be old [s]
constexpr double kMargin = 0.12;         ///< around a framed model [-]
constexpr double kSlack = 0.1;  ///< a framed model may change by this before the view follows [-]

/// From the front, somewhat from the left and above: all three planes of an image are seen.
const ViewCamera kObliqueView = {.view = {-0.45, 0.75, -0.4}, .up = {0, 0, 1}};

constexpr std::array<std::pair<KeyCommand, StandardView>, 6> kSides = {
    {{KeyCommand::Anterior, StandardView::Anterior},
     {KeyCommand::Posterior, StandardView::Posterior},
     {KeyCommand::Left, StandardView::Left},
     {KeyCommand::Right, StandardView::Right},
     {KeyCommand::Superior, StandardView::Superior},
     {KeyCommand::Inferior, StandardView::Inferior}}};

/// The camera that looks at a place.
/// \param outward the side from which it is seen; zero: as now
ViewCamera looking_at(ViewCamera camera, const Vec3& place, const Vec3& outward) {
    camera.centre = place;
    camera.half_height = std::min(camera.half_height, kLookHeight);
    if (outward.isZero()) return camera;
    // The least turn, so that the user keeps track of what is up.
    const auto turn = Eigen::Quaterniond::FromTwoVectors(camera.view, -outward);
    camera.up = turn * camera.up;
    camera.view = -outward;
    return camera;
}

/// Between two cameras, a share of the way.
ViewCamera between(const ViewCamera& from, const ViewCamera& to, double share) {
    ViewCamera camera = to;
    const Eigen::Matrix3d axes =
        Eigen::Quaterniond(to_eye(from)).slerp(share, Eigen::Quaterniond(to_eye(to))).matrix();
    camera.up = axes.row(1);
    camera.view = -axes.row(2);
    camera.centre = from.centre + share * (to.centre - from.centre);
    camera.half_height = from.half_height * std::pow(to.half_height / from.half_height, share);
    return camera;
}

}  // namespace

void CameraControl::face(StandardView side) {
    camera_ = facing(camera_, side);
}

void CameraControl::forget() {
    leave_project();
    endoscope_ = {};
    flight_.reset();
    picker_.forget();
    centring_.reset();
    outside_.reset();
    framed_camera_.reset();
}

void CameraControl::leave_project() {
    if (!std::exchange(has_project_, false)) return;
    const ViewCamera last = outside_.value_or(camera_);
    const bool untouched =
        !std::exchange(begun_, false) || (framed_camera_ == last && !kept_.camera());
    kept_.close(untouched ? std::nullopt : std::optional(last));
}

bool CameraControl::follow_project(const Document& document) {
    kept_.update();
    if (std::exchange(seen_opened_, document.opened()) == document.opened()) return false;
    leave_project();
    if (!document.is_open()) return true;
    kept_.open(document.project(), document.snapshot()->read_only_reason);
    has_project_ = true;
    return true;
}

// --- framing

bool CameraControl::begin(const ViewContent& content) {
    const bool empty = content.surface == nullptr && !content.image;
    if (begun_ || empty || !kept_.is_read()) return false;
    begun_ = true;
    const auto left = kept_.camera();
    if (left) {
        camera_ = *left;
        framed_camera_.reset();
        return true;
    }
    camera_ = content.surface != nullptr ? facing(camera_, StandardView::Anterior) : kObliqueView;
    frame(content);
    return true;
}

void CameraControl::frame(const ViewContent& content) {
    outside_.reset();
    if (content.surface != nullptr)
        camera_ = framed(camera_, content.surface->points(), content.aspect, kMargin);
    else if (content.image)
        camera_ = framed(camera_, *content.image, content.aspect, kMargin);
    framed_camera_ = camera_;
}

void CameraControl::follow(const ViewContent& content) {
    if (content.surface == nullptr || framed_camera_ != camera_) return;
    const ViewCamera fitting = framed(camera_, content.surface->points(), content.aspect, kMargin);
    const double growth = fitting.half_height / camera_.half_height;
    const double shift = (fitting.centre - camera_.centre).norm() / camera_.half_height;
    if (growth <= 1.0 + kSlack && growth >= 1.0 - 3.0 * kSlack && shift <= kSlack) return;
    camera_ = fitting;
    framed_camera_ = camera_;
}

void CameraControl::reach(const Positions& places, const ViewContent& content) {
    if (places.empty() || content.surface == nullptr || framed_camera_ != camera_) return;
    Positions points = places;
    const Positions& shown = content.surface->points();
    points.insert(points.end(), shown.begin(), shown.end());
    camera_ = framed(camera_, points, content.aspect, kMargin);
    framed_camera_ = camera_;
}

// --- mouse and keys

void CameraControl::handle_drag(const PixelView& view, const ViewPixel& mouse, bool left_is_free) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    const ViewPixel by(io.MouseDelta.x, io.MouseDelta.y);
    if (!ImGui::IsItemActive() || by.norm() == 0 || !(middle || left_is_free)) return;
    const double turn = kTurnPerHeight / view.height;
    if (is_inside())
        endoscope_.look_round(-turn * by.x() / 2, turn * by.y() / 2);
    else if (middle || io.KeyShift)
        camera_ = panned(camera_, view.aspect(), view.ndc(mouse - by), view.ndc(mouse));
    else
        camera_ = turned(camera_, turn * by.x(), -turn * by.y());
}

void CameraControl::handle_wheel(const PixelView& view, const ViewPixel& mouse, ClipChoice& plane) {
    const double notches = ImGui::GetIO().MouseWheel;
    if (notches == 0) return;
    take_keyboard();
    if (plane.on && ImGui::GetIO().KeyCtrl)
        plane.place = std::clamp(plane.place + kClipPerNotch * notches, 0.0, 1.0);
    else if (is_inside())
        endoscope_.advance(kFlightPerNotch * notches);
    else
        camera_ = zoomed(camera_, view.aspect(), std::pow(kZoomPerNotch, notches), view.ndc(mouse));
}

void CameraControl::handle_keys(const PanelContext& c, const ViewContent& content, bool over) {
    if (!over) return;
    if (c.place.view.flies)
        endoscope_.handle_keys(c.shown.keys);
    else
        handle_view_keys(c.shown.keys, content);
}

void CameraControl::handle_view_keys(const KeyCommands& keys, const ViewContent& content) {
    for (const auto& [command, side] : kSides)
        if (keys.has(command)) face(side);
    if (keys.has(KeyCommand::Perspective)) switch_perspective();
    if (keys.has(KeyCommand::FrameAll)) frame(content);
}

void CameraControl::take_look(const Workplace& place, const ViewContent& content) {
    if (std::exchange(seen_frames_, place.frames()) != place.frames()) frame(content);
    const bool asked = std::exchange(seen_looks_, place.looks()) != place.looks();
    if (is_inside()) return flight_.reset();
    if (asked && place.looked_at()) {
        const ViewCamera to = looking_at(camera_, *place.looked_at(), place.looked_from());
        flight_.emplace(Flight{.from = camera_, .to = to, .last = camera_});
    }
    if (flight_) continue_flight(ImGui::GetIO().DeltaTime);
}

void CameraControl::continue_flight(double seconds) {
    if (camera_ != flight_->last) return flight_.reset();
    flight_->done += std::min(seconds, kLongestStep) / kFlightTime;
    const double t = flight_->done;
    camera_ = t < 1.0 ? between(flight_->from, flight_->to, t * t * (3.0 - 2.0 * t)) : flight_->to;
    flight_->last = camera_;
    if (t >= 1.0) flight_.reset();
}

void CameraControl::request_centre(const SceneView& view, const Layers& layers,
                                   const Eigen::Vector2i& pixel) {
    centring_ = camera_;
    picker_.request(view, layers, pixel.x(), pixel.y());
}

bool CameraControl::take_centre() {
    const auto picked = picker_.result();
    if (!picked || centring_ != camera_) return false;
    if (picked->layer != 0) camera_.centre = picked->point;
    return picked->layer == 0;
}

// --- the lumen

void CameraControl::fly(const PanelContext& c) {
    endoscope_.update(c, ImGui::GetIO().DeltaTime);
    const auto inside = endoscope_.camera();
    if (inside && !outside_) outside_ = camera_;
    if (inside)
        camera_ = *inside;
    else if (outside_)
        camera_ = *std::exchange(outside_, std::nullopt);
}

}  // namespace vesselbench
