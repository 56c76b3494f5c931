#include "workbench/window/features/handles/neck_handles.h"

#include <optional>

#include "geometry/kernel/cross_section.h"
#include "workbench/window/features/handles/handle_values.h"

namespace vesselbench {

namespace {

/// Of the ring, and of the arm to the handle that turns it [distances of the dome].
constexpr double kRing = 0.6, kArm = 0.8;

struct ShownNeck {
    Vec3 dome = Vec3::Zero();
    Plane plane;  ///< its normal points to the dome

    [[nodiscard]] double reach() const { return (dome - plane.point).norm(); }
};

std::optional<ShownNeck> neck_of(const OperationForm& form) {
    const auto dome = shown_value<Vec3>(form, name_of(form, Meaning::Tip)),
               at = shown_value<Vec3>(form, name_of(form, Meaning::Place)),
               normal = shown_value<Vec3>(form, name_of(form, Meaning::Neck));
    if (!dome || !at || !normal || !(normal->norm() > 0.0) || *dome == *at) return std::nullopt;
    ShownNeck neck{*dome, {*at, normal->normalized()}};
    if (neck.plane.distance(*dome) < 0.0) neck.plane.normal = -neck.plane.normal;
    return neck;
}

}  // namespace

FormShape neck_shape(const OperationForm& form) {
    FormShape shape;
    const auto neck = neck_of(form);
    if (!neck) return shape;
    const Plane& plane = neck->plane;
    const Vec3 tip = plane.point + kArm * neck->reach() * plane.normal;
    const bool faint = !value_of(form, name_of(form, Meaning::Neck));
    shape.lines.push_back(circle_line(plane.point, plane.normal, kRing * neck->reach()));
    shape.lines.back().faint = faint;
    shape.lines.push_back({.points = {plane.point, tip}, .faint = faint});
    shape.handles = {{.name = "neck.at",
                      .point = plane.point,
                      .path = HandlePath::Line,
                      .direction = plane.normal,
                      .help = "Move the neck's plane along its normal"},
                     {.name = "neck.normal",
                      .point = tip,
                      .path = HandlePath::Ball,
                      .pivot = plane.point,
                      .look = HandleLook::Ring,
                      .help = "Turn the neck's plane"}};
    return shape;
}

std::vector<FieldText> neck_texts(const OperationForm& form, std::size_t handle, const Vec3& to) {
    const auto before = neck_of(form);
    if (!before) return {};
    Plane plane = before->plane;
    if (handle == 0)
        plane.point += plane.normal.dot(to - plane.point) * plane.normal;
    else if (const Vec3 turned = to - plane.point; turned.norm() > 0.0)
        plane.normal = turned.normalized();
    return {point_text(name_of(form, Meaning::Tip), before->dome),
            point_text(name_of(form, Meaning::Place), plane.point),
            direction_text(name_of(form, Meaning::Neck), plane.normal)};
}

}  // namespace vesselbench
