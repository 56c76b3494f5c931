#include "workbench/window/features/handles/crop_handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

constexpr double kMargin = 0.02;       ///< of an offered box around a surface, of its diagonal [-]
constexpr double kOfferedBall = 0.25;  ///< radius of an offered ball, of the diagonal [-]
constexpr double kLeastSize = 0.1;     ///< of a region that is dragged [mm]
constexpr std::size_t kFaces = 6;
constexpr std::size_t kCorners = 8;

struct Box {
    Vec3 low, high;
};

struct Ball {
    Vec3 centre;
    double radius;
};

/// Outer edges of its voxels.
Bounds image_box(const Image& image) {
    const SliceGrid grid = slice_grid(image);
    return {grid.low, grid.high()};
}

Bounds with_margin(const Bounds& model) {
    const Vec3 margin = Vec3::Constant(kMargin * model.diagonal());
    return {model.min - margin, model.max + margin};
}

struct Region {
    std::optional<Box> box;
    std::optional<Ball> ball;
    bool offered = false;  ///< something of it is not given
};

Region region_of(const OperationForm& form, const Bounds& offered) {
    const std::vector<double> box = list_of(form, "box");
    if (box.size() == 6)
        return {.box = Box{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}}, .ball = {}};
    if (!text_of(form, "box").empty()) return {};
    const auto centre = point_of(form, "centre");
    const auto radius = number_of(form, "radius");
    if (centre || radius)
        return {.box = {},
                .ball = Ball{centre.value_or(offered.centre()),
                             radius.value_or(kOfferedBall * offered.diagonal())},
                .offered = !centre || !radius};
    return {.box = Box{offered.min, offered.max}, .ball = {}, .offered = true};
}

Vec3 corner_of(const Box& box, std::size_t corner) {
    const auto part = [&](int axis) {
        return ((corner >> axis) & 1U) != 0 ? box.high[axis] : box.low[axis];
    };
    return {part(0), part(1), part(2)};
}

/// "x0" for the low side of the first axis, "z1" for the high side of the last one.
std::string side_name(std::size_t axis, bool high) {
    constexpr std::array<char, 3> kAxes = {'x', 'y', 'z'};
    return {kAxes[axis], high ? '1' : '0'};
}

std::string side_name(std::size_t side) {
    return side_name(side % 3, side >= 3);
}

Handle face_handle(const Box& box, std::size_t face) {
    const auto axis = static_cast<int>(face % 3);
    Vec3 point = 0.5 * (box.low + box.high);
    point[axis] = face < 3 ? box.low[axis] : box.high[axis];
    return {.name = "crop.face." + side_name(face),
            .point = point,
            .path = HandlePath::Line,
            .direction = Vec3::Unit(axis),
            .help = "Move this face of the box"};
}

std::vector<Handle> box_handles(const Box& box) {
    std::vector<Handle> handles;
    for (std::size_t face = 0; face < kFaces; ++face) handles.push_back(face_handle(box, face));
    for (std::size_t corner = 0; corner < kCorners; ++corner)
        handles.push_back({.name = "crop.corner." + std::to_string(corner),
                           .point = corner_of(box, corner),
                           .look = HandleLook::Square,
                           .help = "Move this corner of the box in the plane of the view"});
    return handles;
}

Vec3 place_on(const Ball& ball, std::size_t place) {
    const Vec3 axis = Vec3::Unit(static_cast<int>(place % 3));
    return ball.centre + (place < 3 ? -ball.radius : ball.radius) * axis;
}

std::vector<Handle> ball_handles(const Ball& ball) {
    std::vector<Handle> handles = {{.name = "crop.centre",
                                    .point = ball.centre,
                                    .look = HandleLook::Square,
                                    .help = "Move the ball in the plane of the view"}};
    for (std::size_t place = 0; place < kFaces; ++place)
        handles.push_back({.name = "crop.radius." + side_name(place),
                           .point = place_on(ball, place),
                           .path = HandlePath::Line,
                           .direction = Vec3::Unit(static_cast<int>(place % 3)),
                           .help = "Change the ball's radius"});
    return handles;
}

std::string size_text(const Box& box) {
    const Vec3 size = box.high - box.low;
    return formatted(size.x(), "%.1f \u00D7 ") + formatted(size.y(), "%.1f \u00D7 ") +
           formatted(size.z(), "%.1f mm");
}

std::vector<FieldText> box_texts(const Box& box) {
    return {{"box", to_text(Value(std::vector<double>{box.low.x(), box.low.y(), box.low.z(),
                                                      box.high.x(), box.high.y(), box.high.z()}))}};
}

/// One side of one axis; it stays on its side of the other one.
void move_side(Box& box, int axis, bool high, double to) {
    if (high)
        box.high[axis] = std::max(rounded_length(to), box.low[axis] + kLeastSize);
    else
        box.low[axis] = std::min(rounded_length(to), box.high[axis] - kLeastSize);
}

Box dragged(Box box, std::size_t handle, const Vec3& to) {
    box = {rounded_place(box.low), rounded_place(box.high)};
    if (handle < kFaces) {
        const auto axis = static_cast<int>(handle % 3);
        move_side(box, axis, handle >= 3, to[axis]);
        return box;
    }
    const std::size_t corner = handle - kFaces;
    for (int axis = 0; axis < 3; ++axis)
        move_side(box, axis, ((corner >> axis) & 1U) != 0, to[axis]);
    return box;
}

// --- in slices

/// Which sides of the box a handle in a slice moves: -1 the low one, 1 the high one, 0 none.
struct SliceHandle {
    int across, along;
};

constexpr std::array<SliceHandle, 8> kSliceHandles = {
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

double place_between(double low, double high, int side) {
    return side < 0 ? low : side > 0 ? high : 0.5 * (low + high);
}

Handle slice_handle(const Box& box, const SliceHandle& at, const SliceAxes& axes, double position) {
    Handle handle{.name = std::string("crop.") + axes.key + "."};
    handle.point[axes.normal] = position;
    for (const auto& [axis, side] : {std::pair(axes.across, at.across), {axes.along, at.along}}) {
        handle.point[axis] = place_between(box.low[axis], box.high[axis], side);
        if (side == 0) continue;
        handle.name += side_name(static_cast<std::size_t>(axis), side > 0);
        handle.direction = Vec3::Unit(axis);
    }
    const bool corner = at.across != 0 && at.along != 0;
    handle.path = corner ? HandlePath::Free : HandlePath::Line;
    handle.look = corner ? HandleLook::Square : HandleLook::Dot;
    handle.help = corner ? "Move this corner of the box" : "Move this side of the box";
    return handle;
}

FormShape rectangle_in_slice(const Box& box, const SliceAxes& axes, double position) {
    FormShape shape;
    for (const SliceHandle& at : kSliceHandles)
        shape.handles.push_back(slice_handle(box, at, axes, position));
    RegionLine line{.closed = true};
    for (const std::size_t corner : {4, 5, 7, 6})
        line.points.push_back(shape.handles[corner].point);
    line.faint = position < box.low[axes.normal] || position > box.high[axes.normal];
    shape.lines.push_back(std::move(line));
    return shape;
}

/// Empty beside the ball.
FormShape circle_in_slice(const Ball& ball, const SliceAxes& axes, double position) {
    const double away = position - ball.centre[axes.normal];
    if (std::abs(away) >= ball.radius) return {};
    Vec3 centre = ball.centre;
    centre[axes.normal] = position;
    const double radius = std::sqrt(ball.radius * ball.radius - away * away);
    return {.lines = {circle_line(centre, Vec3::Unit(axes.normal), radius)}};
}

Ball dragged(Ball ball, std::size_t handle, const Vec3& to) {
    if (handle == 0) {
        ball.centre = to;
    } else {
        const auto axis = static_cast<int>((handle - 1) % 3);
        const double side = handle <= 3 ? -1.0 : 1.0;
        ball.radius = std::max(kLeastSize, side * (to - ball.centre)[axis]);
    }
    return {rounded_place(ball.centre), rounded_length(ball.radius)};
}

}  // namespace

void OfferedBox::update(const Scene* scene, const OperationForm* form) {
    const bool crops = form != nullptr && scene != nullptr && has_field(*form, Meaning::Box);
    const bool imaged = crops && scene->image && !scene->image->empty();
    const bool surfaced = crops && !imaged && scene->surface && !scene->surface->empty();
    const auto voxels = imaged ? scene->image->voxels : nullptr;
    const auto positions = surfaced ? scene->surface->positions : nullptr;
    if (voxels == voxels_ && positions == positions_) return;
    voxels_ = voxels;
    positions_ = positions;
    bounds_.reset();
    if (imaged) bounds_ = image_box(*scene->image);
    if (surfaced) bounds_ = with_margin(vesselbench::bounds(*scene->surface));
}

FormShape crop_shape(const OperationForm& form, const Bounds& offered) {
    FormShape shape;
    const Region region = region_of(form, offered);
    if (region.box) {
        shape.lines = box_lines(region.box->low, region.box->high);
        shape.handles = box_handles(*region.box);
        if (!region.offered)
            shape.notes.push_back({corner_of(*region.box, 7), size_text(*region.box)});
    } else if (region.ball) {
        shape.lines = ball_lines(region.ball->centre, region.ball->radius);
        shape.handles = ball_handles(*region.ball);
        shape.notes.push_back(
            {place_on(*region.ball, 5), "radius " + formatted(region.ball->radius, "%.1f mm")});
    }
    for (RegionLine& line : shape.lines) line.faint = region.offered;
    return shape;
}

std::vector<FieldText> crop_texts(const OperationForm& form, const Bounds& offered,
                                  std::size_t handle, const Vec3& to) {
    const Region region = region_of(form, offered);
    if (region.box) return box_texts(dragged(*region.box, handle, to));
    if (!region.ball) return {};
    const Ball ball = dragged(*region.ball, handle, to);
    return {{"centre", to_text(Value(ball.centre))}, {"radius", to_text(Value(ball.radius))}};
}

FormShape crop_slice_shape(const OperationForm& form, const Bounds& offered, SlicePlane plane,
                           double position) {
    const Region region = region_of(form, offered);
    const SliceAxes& axes = axes_of(plane);
    FormShape shape;
    if (region.box) shape = rectangle_in_slice(*region.box, axes, position);
    if (region.ball) shape = circle_in_slice(*region.ball, axes, position);
    for (RegionLine& line : shape.lines) line.faint = line.faint || region.offered;
    return shape;
}

std::vector<FieldText> crop_slice_texts(const OperationForm& form, const Bounds& offered,
                                        SlicePlane plane, std::size_t handle, const Vec3& to) {
    const Region region = region_of(form, offered);
    if (!region.box) return {};
    const SliceAxes& axes = axes_of(plane);
    const auto [across, along] = kSliceHandles.at(handle);
    Box box{rounded_place(region.box->low), rounded_place(region.box->high)};
    if (across != 0) move_side(box, axes.across, across > 0, to[axes.across]);
    if (along != 0) move_side(box, axes.along, along > 0, to[axes.along]);
    return box_texts(box);
}

std::vector<FieldText> crop_rectangle_texts(const OperationForm& form, const Bounds& offered,
                                            SlicePlane plane, const Vec3& from, const Vec3& to) {
    const Region region = region_of(form, offered);
    Box box = region.box.value_or(Box{offered.min, offered.max});
    const SliceAxes& axes = axes_of(plane);
    for (const int axis : {axes.across, axes.along}) {
        box.low[axis] = std::min(from[axis], to[axis]);
        box.high[axis] = std::max({from[axis], to[axis], box.low[axis] + kLeastSize});
    }
    std::vector<FieldText> texts = box_texts({rounded_place(box.low), rounded_place(box.high)});
    // A box and a ball exclude each other.
    for (const char* part : {"centre", "radius"}) texts.push_back({part, ""});
    return texts;
}

}  // namespace vesselbench
