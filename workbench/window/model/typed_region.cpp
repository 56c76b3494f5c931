#include "workbench/window/model/typed_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesselbench {

namespace {

constexpr int kCirclePoints = 96;

/// The value of a field; none if there is no such field, or it is empty or wrong.
std::optional<Value> value_of(const OperationForm& form, const std::string& name) {
    for (const FormField& field : form.fields())
        if (field.parameter->name == name && field.active && !field.text.empty() &&
            field.error.empty())
            return checked_value(*field.parameter, Value(field.text));
    return std::nullopt;
}

std::vector<RegionLine> box_lines(const Vec3& low, const Vec3& high) {
    const auto corner = [&](int i) {
        return Vec3((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                    (i & 4) != 0 ? high.z() : low.z());
    };
    std::vector<RegionLine> lines = {{{corner(0), corner(1), corner(3), corner(2)}, true},
                                     {{corner(4), corner(5), corner(7), corner(6)}, true}};
    for (int i = 0; i < 4; ++i) lines.push_back({{corner(i), corner(i + 4)}, false});
    return lines;
}

std::vector<RegionLine> ball_lines(const Vec3& centre, double radius) {
    std::vector<RegionLine> lines;
    for (int axis = 0; axis < 3; ++axis) {
        RegionLine circle{.points = {}, .closed = true};
        const Vec3 a = radius * Vec3::Unit((axis + 1) % 3), b = radius * Vec3::Unit((axis + 2) % 3);
        for (int i = 0; i < kCirclePoints; ++i) {
            const double angle = 2 * std::numbers::pi * i / kCirclePoints;
            circle.points.emplace_back(centre + std::cos(angle) * a + std::sin(angle) * b);
        }
        lines.push_back(std::move(circle));
    }
    return lines;
}

}  // namespace

std::vector<RegionLine> region_lines(const OperationForm& form) {
    if (const auto box = value_of(form, "box")) {
        const auto* numbers = std::get_if<std::vector<double>>(&*box);
        if (numbers == nullptr || numbers->size() != 6) return {};
        return box_lines(Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]),
                         Vec3((*numbers)[3], (*numbers)[4], (*numbers)[5]));
    }
    const auto centre = value_of(form, "centre"), radius = value_of(form, "radius");
    if (!centre || !radius) return {};
    return ball_lines(std::get<Vec3>(*centre), std::get<double>(*radius));
}

}  // namespace vesselbench
