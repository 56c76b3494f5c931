#include "workbench/window/case/stroke.h"

#include <algorithm>
#include <cmath>

namespace vesselbench {

namespace {

/// By the radius: close enough that single dabs do not show.
constexpr double kSpacing = 0.25;

constexpr double kRadiusStep = 1.2, kStrengthStep = 0.05;

/// What a radius may be [mm]: no vessel needs more.
constexpr double kSmallest = 0.01, kLargest = 100.0;

/// cos 60 degrees: places whose normals differ more are on different parts of the surface.
constexpr double kSamePart = 0.5;

double rounded(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
    // A power of ten below 1 is not exact; its reciprocal is.
    return unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                      : std::round(value / unit) * unit;
}

}  // namespace

BrushTip scaled(const BrushTip& tip, double factor) {
    BrushTip result = tip;
    if (tip.radius > 0.0)
        result.radius = rounded(std::clamp(tip.radius * factor, kSmallest, kLargest));
    return result;
}

BrushTip after_key(const BrushTip& tip, BrushKey key) {
    if (key == BrushKey::Smaller) return scaled(tip, 1.0 / kRadiusStep);
    if (key == BrushKey::Larger) return scaled(tip, kRadiusStep);
    const double step = key == BrushKey::Stronger ? kStrengthStep : -kStrengthStep;
    return with_strength(tip, std::abs(tip.strength) + step);
}

BrushTip with_strength(const BrushTip& tip, double strength) {
    const double fits = std::clamp(std::round(strength * 100.0) / 100.0, kStrengthStep, 1.0);
    return {tip.radius, std::copysign(fits, tip.strength)};
}

void Stroke::begin(double radius) {
    state_ = State::Deciding;
    spacing_ = kSpacing * radius;
    last_.reset();
}

void Stroke::cancel() {
    if (state_ != State::Idle) state_ = State::Dropped;
}

std::vector<StrokePlace> Stroke::extend(const std::optional<StrokePlace>& place) {
    if (state_ == State::Deciding) state_ = place ? State::Painting : State::Turning;
    if (state_ != State::Painting) return {};
    std::vector<StrokePlace> dabs;
    if (place) dabs = dabs_to(*place);
    last_ = place;
    return dabs;
}

std::vector<StrokePlace> Stroke::dabs_to(const StrokePlace& place) {
    if (!last_ || last_->normal.dot(place.normal) < kSamePart) {
        next_ = spacing_;
        return {place};
    }
    const double length = (place.point - last_->point).norm();
    std::vector<StrokePlace> dabs;
    for (; next_ <= length; next_ += spacing_) {
        const double share = length > 0.0 ? next_ / length : 1.0;
        const Vec3 normal = (1.0 - share) * last_->normal + share * place.normal;
        dabs.push_back({.point = (1.0 - share) * last_->point + share * place.point,
                        .normal = normal.normalized(),
                        .between = true});
    }
    next_ -= length;
    return dabs;
}

}  // namespace vesselbench
