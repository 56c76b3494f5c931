#include "workbench/prepare/end_picture.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/measure.h"
#include "geometry/vessel/openings/end_texts.h"
#include "workbench/prepare/end_role.h"
#include "workbench/report/report_pictures.h"

namespace vesselbench {

namespace {

constexpr int kSide = 900;        // pixels
constexpr double kDigit = 18.0;   // pixels
constexpr double kMargin = 1.15;  // of the model's half height

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

std::vector<EndMark> marks_of(const OpeningPlan& plan) {
    std::vector<EndMark> marks;
    for (const EndRecord& end : plan.ends)
        if (end.number > 0) marks.push_back({end.place, end.number, shown_role(plan, end)});
    return marks;
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
    const std::vector<EndMark> marks = marks_of(plan);
    for (std::size_t i = 0; i < pictures.size(); ++i)
        draw_marks(pictures[i], marks, views[i], centre, kDigit);
    return side_by_side(pictures);
}

}  // namespace vesselbench
