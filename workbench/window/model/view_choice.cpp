#include "workbench/window/model/view_choice.h"

#include <algorithm>

namespace vesselbench {

namespace {

Vec3 direction_of(ClipAxis axis, const Vec3& view) {
    switch (axis) {
        case ClipAxis::Sagittal:
            return Vec3::UnitX();
        case ClipAxis::Coronal:
            return Vec3::UnitY();
        case ClipAxis::Axial:
            return Vec3::UnitZ();
        case ClipAxis::Camera:
            break;
    }
    return -view.normalized();
}

}  // namespace

std::optional<Plane> clip_plane(const ClipChoice& choice, const Bounds& box, const Vec3& view) {
    if (!choice.on) return std::nullopt;
    const Vec3 direction = direction_of(choice.axis, view);
    const Vec3 middle = box.centre();
    const double reach = 0.5 * (box.max - box.min).cwiseAbs().dot(direction.cwiseAbs());
    const double along = (2.0 * std::clamp(choice.place, 0.0, 1.0) - 1.0) * reach;
    return Plane{middle + along * direction, choice.flipped ? Vec3(-direction) : direction};
}

bool hides_section(ClipAxis axis, const Vec3& view) {
    return direction_of(axis, view).dot(view) > 1e-9 * view.norm();
}

void ViewChoice::choose(ColouringKind kind) {
    colouring = kind;
    range.reset();
    if (kind != ColouringKind::Patches) last_colouring = kind;
    // Its colours are those of a section.
    if (kind == ColouringKind::TetrahedraQuality) clip.on = true;
}

}  // namespace vesselbench
