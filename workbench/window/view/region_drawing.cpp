#include "workbench/window/view/region_drawing.h"

#include <utility>

namespace vesselbench {

namespace {

const Colour kLineColour(0.95F, 0.55F, 0.08F);

constexpr double kHidden = 0.3;  ///< opacity of what is behind the surface [-]

}  // namespace

void RegionDrawing::show(std::vector<RegionLine> lines) {
    if (lines == shown_) return;
    shown_ = std::move(lines);
    ++version_;
    std::vector<Polyline> drawn;
    for (const RegionLine& line : shown_) drawn.push_back({line.points, kLineColour, line.closed});
    lines_ = drawn.empty() ? nullptr : std::make_shared<const DrawnLines>(drawn);
}

void RegionDrawing::add_to(Layers& layers, double width) const {
    if (lines_)
        layers.lines.push_back({.lines = lines_, .width = width, .hidden_opacity = kHidden});
}

}  // namespace vesselbench
