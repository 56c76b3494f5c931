#include "workbench/window/drawing/view_choice.h"

#include <algorithm>

#include "workbench/window/case/readable.h"

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
    forget_range();
    if (kind != ColouringKind::Patches) last_colouring = kind;
    // Its colours are those of a section.
    if (kind == ColouringKind::TetrahedraQuality) clip.on = true;
}

void ViewChoice::switch_clip(bool has_cells) {
    clip.on = !clip.on;
    if (clip.on && has_cells && colouring == ColouringKind::Patches)
        choose(ColouringKind::TetrahedraQuality);
    else if (!clip.on && colouring == ColouringKind::TetrahedraQuality)
        choose(ColouringKind::Patches);
}

void ViewChoice::draw_as(const DrawnQuantity& quantity, const std::optional<ValueRange>& range) {
    if (drawn_ != quantity) forget_range();
    drawn_ = quantity;
    automatic = range;
}

std::optional<ValueRange> ViewChoice::range() const {
    if (!has_typed_range()) return std::nullopt;
    const auto end = [&](const std::string& text, double ValueRange::*part) {
        if (text.empty() && automatic) return std::optional(*automatic.*part);
        return typed_number(text);
    };
    const auto from = end(least, &ValueRange::least), to = end(most, &ValueRange::most);
    if (!from || !to || !(*from < *to)) return std::nullopt;
    return ValueRange{*from, *to};
}

void ViewChoice::forget_range() {
    least.clear();
    most.clear();
}

}  // namespace vesselbench
