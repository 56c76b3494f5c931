#include "workbench/window/drawing/region_drawing.h"

#include <utility>

namespace vesselbench {

namespace {

const Colour kLineColour(0.95F, 0.55F, 0.08F);
const Colour kFaintColour(0.42F, 0.50F, 0.60F);

constexpr double kHidden = 0.3;      ///< opacity of what is behind the surface [-]
constexpr double kFaintWidth = 0.6;  ///< of the usual width [-]

template <class Wanted>
std::shared_ptr<const DrawnLines> drawn(const std::vector<RegionLine>& lines, Wanted wanted) {
    std::vector<Polyline> chosen;
    for (const RegionLine& line : lines)
        if (wanted(line))
            chosen.push_back({line.points, line.faint ? kFaintColour : kLineColour, line.closed});
    return chosen.empty() ? nullptr : std::make_shared<const DrawnLines>(chosen);
}

}  // namespace

void RegionDrawing::show(std::vector<RegionLine> lines) {
    if (lines == shown_) return;
    shown_ = std::move(lines);
    ++version_;
    faint_ = front_ = lines_ = nullptr;  // should the device lack memory for the new ones
    faint_ = drawn(shown_, [](const RegionLine& line) { return line.faint; });
    front_ = drawn(shown_, [](const RegionLine& line) { return line.in_front; });
    lines_ = drawn(shown_, [](const RegionLine& line) { return !line.faint && !line.in_front; });
}

void RegionDrawing::add_to(Layers& layers, double width, double pull) const {
    if (faint_)
        layers.lines.push_back(
            {.lines = faint_, .width = kFaintWidth * width, .hidden_opacity = 2 * kHidden});
    if (lines_)
        layers.lines.push_back({.lines = lines_, .width = width, .hidden_opacity = kHidden});
    if (front_)
        layers.lines.push_back(
            {.lines = front_, .width = 1.5 * width, .hidden_opacity = kHidden, .pull = pull});
}

}  // namespace vesselbench
