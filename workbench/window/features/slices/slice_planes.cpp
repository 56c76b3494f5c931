#include "workbench/window/features/slices/slice_planes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vesselbench {

namespace {

constexpr Paint kOutline = paint(0xF2C14E);  ///< legible on grey, and no colour of an axis
constexpr double kMaskOpacity = 0.4;         ///< [-]
constexpr double kPull = 2e-3;               ///< of lines in a slice, by its size [-]

void upload(std::shared_ptr<DrawnSlice>& drawn, const ImageSlice& slice) {
    const SliceScalars scalars{.corner = slice.corner,
                               .across = slice.across,
                               .down = slice.down,
                               .columns = slice.columns,
                               .rows = slice.rows,
                               .values = slice.values};
    if (drawn)
        drawn->replace(scalars);
    else
        drawn = std::make_shared<DrawnSlice>(scalars);
}

std::shared_ptr<const DrawnLines> drawn_lines(const std::vector<SliceLine>& lines, Paint colour) {
    if (lines.empty()) return nullptr;
    std::vector<Polyline> all;
    for (const SliceLine& line : lines) all.push_back({line.points, linear(colour), line.closed});
    return std::make_shared<const DrawnLines>(all);
}

}  // namespace

Paint paint_of(SlicePlane plane) {
    switch (plane) {
        case SlicePlane::Axial:
            return paint(0x5B9BE0);
        case SlicePlane::Coronal:
            return paint(0x5FB87A);
        default:
            return paint(0xE06C62);
    }
}

Colour linear(Paint colour) {
    const auto part = [&](int shift) {
        return std::pow(static_cast<float>((colour >> shift) & 0xFF) / 255.0F, 2.2F);
    };
    return {part(0), part(8), part(16)};
}

void SlicePlanes::upload(Drawn& drawn, std::shared_ptr<const SliceContent> content, Paint colour) {
    drawn.content = std::move(content);
    if (!drawn.content) {
        drawn = {};
        return;
    }
    vesselbench::upload(drawn.image, drawn.content->image);
    if (drawn.content->mask)
        vesselbench::upload(drawn.mask, *drawn.content->mask);
    else
        drawn.mask.reset();
    drawn.outline = drawn_lines(drawn.content->outline, kOutline);
    drawn.border = drawn_lines(drawn.content->border, colour);
}

void SlicePlanes::update(const ImageSlices& slices) {
    Look look{.grey = slices.grey(),
              .labels = slices.shows_labels(),
              .mask = slices.mask_shown,
              .outline = slices.outline_shown};
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        look.in_space[i] = slices.in_space(kSlicePlanes[i]);
        if (planes_[i].content == slices.content(kSlicePlanes[i])) continue;
        upload(planes_[i], slices.content(kSlicePlanes[i]), paint_of(kSlicePlanes[i]));
        ++version_;
        if (look.in_space[i]) ++space_version_;
    }
    if (look == look_) return;
    look_ = look;
    ++version_;
    ++space_version_;
}

bool SlicePlanes::any_in_space() const {
    for (std::size_t i = 0; i < planes_.size(); ++i)
        if (look_.in_space[i] && planes_[i].image) return true;
    return false;
}

void SlicePlanes::add_slices(Layers& layers, const Drawn& drawn, SlicePlane plane) const {
    const auto id = kFirstSliceLayer + static_cast<std::uint32_t>(plane);
    layers.slices.push_back({.slice = drawn.image,
                             .id = id,
                             .window = look_.grey.window,
                             .level = look_.grey.level,
                             .labels = look_.labels});
    if (drawn.mask && look_.mask)
        layers.slices.push_back(
            {.slice = drawn.mask, .opacity = kMaskOpacity, .smooth = false, .labels = true});
}

void SlicePlanes::add_lines(Layers& layers, const Drawn& drawn,
                            const std::shared_ptr<const DrawnLines>& lines, double width) {
    if (lines)
        layers.lines.push_back(
            {.lines = lines, .width = width, .pull = kPull * drawn.image->bounds().radius});
}

void SlicePlanes::add_outline(Layers& layers, const Drawn& drawn, double width) const {
    if (look_.outline) add_lines(layers, drawn, drawn.outline, width);
}

void SlicePlanes::add_to(Layers& layers, double width) const {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        const Drawn& drawn = planes_[i];
        if (!look_.in_space[i] || !drawn.image) continue;
        add_slices(layers, drawn, kSlicePlanes[i]);
        add_outline(layers, drawn, 2 * width);
        add_lines(layers, drawn, drawn.border, 1.5 * width);
    }
}

Layers SlicePlanes::alone(SlicePlane plane, double width) const {
    Layers layers;
    const Drawn& drawn = planes_[static_cast<std::size_t>(plane)];
    if (!drawn.image) return layers;
    add_slices(layers, drawn, plane);
    add_outline(layers, drawn, 2 * width);
    return layers;
}

}  // namespace vesselbench
