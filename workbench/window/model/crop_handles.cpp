#include "workbench/window/model/crop_handles.h"

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

constexpr double kMargin = 0.02;       ///< of an offered box around the model, of its diagonal [-]
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

struct Region {
    std::optional<Box> box;
    std::optional<Ball> ball;
    bool offered = false;  ///< something of it is not given
};

Region region_of(const OperationForm& form, const Bounds& model) {
    const std::vector<double> box = list_of(form, "box");
    if (box.size() == 6)
        return {.box = Box{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}}, .ball = {}};
    if (!text_of(form, "box").empty()) return {};
    const auto centre = point_of(form, "centre");
    const auto radius = number_of(form, "radius");
    if (centre || radius)
        return {.box = {},
                .ball = Ball{centre.value_or(model.centre()),
                             radius.value_or(kOfferedBall * model.diagonal())},
                .offered = !centre || !radius};
    const Vec3 margin = Vec3::Constant(kMargin * model.diagonal());
    return {.box = Box{model.min - margin, model.max + margin}, .ball = {}, .offered = true};
}

Vec3 corner_of(const Box& box, std::size_t corner) {
    const auto part = [&](int axis) {
        return ((corner >> axis) & 1U) != 0 ? box.high[axis] : box.low[axis];
    };
    return {part(0), part(1), part(2)};
}

/// "x0" for the low side of the first axis, "z1" for the high side of the last one.
std::string side_name(std::size_t side) {
    constexpr std::array<char, 3> kAxes = {'x', 'y', 'z'};
    return {kAxes[side % 3], side < 3 ? '0' : '1'};
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

FormShape crop_shape(const OperationForm& form, const Bounds& model) {
    FormShape shape;
    const Region region = region_of(form, model);
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

std::vector<FieldText> crop_texts(const OperationForm& form, const Bounds& model,
                                  std::size_t handle, const Vec3& to) {
    const Region region = region_of(form, model);
    if (region.box) return box_texts(dragged(*region.box, handle, to));
    if (!region.ball) return {};
    const Ball ball = dragged(*region.ball, handle, to);
    return {{"centre", to_text(Value(ball.centre))}, {"radius", to_text(Value(ball.radius))}};
}

}  // namespace vesselbench
