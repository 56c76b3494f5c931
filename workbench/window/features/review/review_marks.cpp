#include "workbench/window/features/review/review_marks.h"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "workbench/window/features/review/review_feature.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

/// Draws marks into one view.
class Marker {
public:
    /// \param shown whether a place is in the picture
    Marker(PanelContext& context, const PixelView& screen, std::string item,
           std::function<bool(const Vec3&)> shown)
        : c(context), screen_(screen), item_(std::move(item)), shown_(std::move(shown)) {}

    void pin(const std::string& name, const Vec3& place, MarkLook look, const std::string& label) {
        if (const auto at = seen(place)) mark(*at, look, label, name);
    }

    void distance(const std::string& name, const ReviewedDistance& distance,
                  const std::string& label) {
        const auto from = seen(distance.from), to = seen(distance.to);
        const std::array<Vec3, 2> ends = {distance.from, distance.to};
        if (from && to) draw_mark_line(c.ui, screen_, ends, false);
        if (from) mark(*from, MarkLook::Picked, to ? "" : label, name + ".from");
        if (to) mark(*to, MarkLook::Picked, label, name);
    }

    PanelContext& c;

private:
    [[nodiscard]] std::optional<ViewPixel> seen(const Vec3& place) const {
        return shown_(place) ? screen_.place(place) : std::nullopt;
    }

    void mark(const ViewPixel& at, MarkLook look, const std::string& label,
              const std::string& name) {
        draw_mark(c.ui, at, look, fitted(label, rect_of(screen_).width - 2 * c.ui.em));
        c.ui.item(item_ + "." + name, spot_rect(at));
    }

    const PixelView& screen_;
    std::string item_;
    std::function<bool(const Vec3&)> shown_;
};

void draw_given(Marker& marker, const ReviewedEdit& edit, bool named) {
    const std::string of_edit = std::to_string(edit.edit.id) + ".";
    for (std::size_t i = 0; i < edit.pins.size(); ++i)
        marker.pin("pin." + of_edit + std::to_string(i), edit.pins[i].pin.place,
                   named ? MarkLook::Picked : MarkLook::Offered,
                   named ? pin_words(edit.pins[i]) : "");
    for (std::size_t i = 0; i < edit.distances.size(); ++i) {
        const GivenDistance& given = edit.distances[i];
        marker.distance("distance." + of_edit + std::to_string(i), given.distance,
                        named ? distance_words(given) : length_words(given.distance));
    }
}

void draw_draft(Marker& marker, ReviewFeature& feature) {
    if (feature.chosen() == nullptr) return;
    const std::string reviewer = marker.c.core.settings.reviewer;
    const VerdictDraft& draft = feature.draft();
    const std::string open = " (not entered)";
    for (std::size_t i = 0; i < draft.pins.size(); ++i)
        marker.pin("draft.pin." + std::to_string(i), draft.pins[i].place, MarkLook::Picked,
                   pin_words({.reviewer = reviewer, .pin = draft.pins[i]}) + open);
    for (std::size_t i = 0; i < draft.distances.size(); ++i)
        marker.distance(
            "draft.distance." + std::to_string(i), draft.distances[i],
            distance_words({.reviewer = reviewer, .distance = draft.distances[i]}) + open);
    if (feature.first_point())
        marker.pin("draft.first", *feature.first_point(), MarkLook::Picked, "");
}

void draw_all(Marker marker) {
    ReviewFeature& feature = marker.c.core.get<ReviewFeature>();
    if (!feature.is_shown() || !feature.review()) return;
    const ReviewedEdit* chosen = feature.chosen();
    for (const ReviewedEdit& edit : feature.review()->edits)
        draw_given(marker, edit, chosen == nullptr || chosen == &edit);
    draw_draft(marker, feature);
}

}  // namespace

void draw_review_marks(PanelContext& c, const PixelView& screen) {
    draw_all({c, screen, "view", [](const Vec3&) { return true; }});
}

void draw_review_marks_in_slice(PanelContext& c, const PixelView& screen,
                                const MarkedSlice& slice) {
    draw_all({c, screen, slice.item, [&slice](const Vec3& place) {
                  return std::abs(place[slice.axis] - slice.position) <= slice.away;
              }});
}

}  // namespace vesselbench
