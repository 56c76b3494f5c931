#include "workbench/window/view/branch_highlight.h"

#include "geometry/kernel/errors.h"
#include "geometry/vessel/openings/branch_part.h"
#include "workbench/window/form/field_text.h"

namespace vesselbench {

namespace {

const Colour kLit(0.95F, 0.42F, 0.08F);

/// None if the operation would fail; it says why.
std::optional<DrawingArrays> lit_part(const Surface& surface, const Vec3& tip, double margin,
                                      const Progress& progress) {
    try {
        const Surface part = branch_part(surface, tip, margin, progress);
        return part.empty() ? std::nullopt : std::optional(prepare_drawing(part));
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace

void BranchHighlight::clear() {
    if (drawn_) ++version_;
    drawn_.reset();
}

void BranchHighlight::update(const OperationForm* form, const Surface* surface,
                             const std::optional<Vec3>& hovered) {
    std::optional<Question> now;
    if (form != nullptr && surface != nullptr && has_field(*form, Meaning::Branch))
        if (const auto tip = hovered ? hovered : point_of(*form, name_of(*form, Meaning::Branch)))
            now = Question{*tip, used_number(*form, "margin")};
    if (!now) {
        if (asked_) task_.forget();
        asked_.reset();
        positions_.reset();
        clear();
        return;
    }
    static_cast<void>(task_.poll());
    if (const auto answer = task_.take()) {
        clear();
        if (*answer) drawn_ = std::make_shared<const DrawnSurface>(**answer);
        ++version_;
    }
    if (asked_ == now && positions_ == surface->positions) return;
    if (positions_ != surface->positions) clear();
    asked_ = now;
    positions_ = surface->positions;
    task_.start_after([surface = *surface, ask = *now](const Progress& progress) {
        return lit_part(surface, ask.tip, ask.margin, progress);
    });
}

void BranchHighlight::add_to(Layers& layers, double pull) const {
    if (!drawn_) return;
    layers.surfaces.push_back(
        {.source = drawn_, .base = kLit, .back = kLit, .pull = pull, .highlighted = true});
}

}  // namespace vesselbench
