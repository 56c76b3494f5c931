#include "workbench/prepare/end_picture.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/end_texts.h"
#include "gpu/role_colours.h"
#include "workbench/prepare/end_role.h"
#include "workbench/report/label_text.h"

namespace vesselbench {

namespace {

constexpr int kSide = 900;        // pixels
constexpr double kDigit = 18.0;   // pixels
constexpr double kDot = 13.0;     // pixels
constexpr double kMargin = 1.15;  // of the model's half height

/// Of numbers: roles' colours are too light for thin strokes on white.
constexpr PixelColour kInk = {25, 30, 35};

/// Patient coordinates are LPS: +y is posterior, +z is superior.
const std::array<Vec3, 2> kViews = {Vec3(0, 1, 0), Vec3(-1, 0, 0)};

ShownRole shown_role(const OpeningPlan& plan, const EndRecord& end) {
    switch (planned_role(plan, end)) {
        case EndRole::Inlet:
            return ShownRole::Inlet;
        case EndRole::Open:
            return ShownRole::Outlet;
        case EndRole::Closed:
            break;
    }
    return end.verdict && looks_like_sac(*end.verdict) ? ShownRole::Sac : ShownRole::Closed;
}

void write_numbers(Picture& picture, const OpeningPlan& plan, const PictureOptions& options,
                   const Vec3& centre) {
    const Vec3 right = options.view.cross(options.up).normalized();
    const Vec3 up = right.cross(options.view).normalized();
    const double scale = 0.5 * kSide / options.half_height;
    for (const EndRecord& end : plan.ends) {
        if (end.number == 0) continue;
        const Vec3 p = end.place - centre;
        const Eigen::Vector2d at(0.5 * kSide + scale * p.dot(right),
                                 0.5 * kSide - scale * p.dot(up));
        const PixelColour colour = pixel_colour(role_colour(shown_role(plan, end)));
        draw_stroke(picture, at, at, kDot, colour);
        write_text(picture, at.x() + 9.0, at.y() - 7.0, std::to_string(end.number), kDigit, kInk);
    }
}

Picture side_by_side(const std::vector<Picture>& pictures) {
    Picture all{.width = kSide * static_cast<int>(pictures.size()), .height = kSide, .rgb = {}};
    for (int row = 0; row < kSide; ++row)
        for (const Picture& picture : pictures) {
            const auto from = picture.rgb.begin() + 3 * row * kSide;
            all.rgb.insert(all.rgb.end(), from, from + 3 * kSide);
        }
    return all;
}

}  // namespace

Picture picture_of_ends(const Surface& surface, const OpeningPlan& plan) {
    const Bounds box = bounds(surface);
    std::vector<PictureOptions> views;
    for (const Vec3& view : kViews)
        views.push_back({.width = kSide,
                         .height = kSide,
                         .view = view,
                         .up = upward_for(view),
                         .half_height = 0.5 * kMargin * box.diagonal()});
    std::vector<Picture> pictures = draw_views(surface, views);
    const Vec3 centre = box.centre();
    for (std::size_t i = 0; i < pictures.size(); ++i)
        write_numbers(pictures[i], plan, views[i], centre);
    return side_by_side(pictures);
}

}  // namespace vesselbench
