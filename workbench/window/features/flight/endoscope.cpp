#include "workbench/window/features/flight/endoscope.h"

#include <algorithm>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/core/core.h"
#include "workbench/window/features/colours/colours_feature.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/slider.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

constexpr double kFieldOfView = 95.0;  ///< of the view's height [deg]
constexpr double kSpeed = 3.0;         ///< of a flight [local radii / s]
constexpr double kKeyStep = 0.5;       ///< of the arrow keys [local radii]
constexpr double kMostUp = 1.4;        ///< gaze up or down [rad]
constexpr double kLongestFrame = 0.1;  ///< longer pauses are no part of a flight [s]

bool same_openings(const std::vector<PatchMeasures>& a, const std::vector<PatchMeasures>& b) {
    return std::ranges::equal(a, b, [](const PatchMeasures& one, const PatchMeasures& other) {
        return one.name == other.name && one.kind == other.kind && one.centroid == other.centroid;
    });
}

}  // namespace

const FlightPath* Endoscope::path() const {
    return flies_ && chosen_ < paths_.size() ? &paths_[chosen_] : nullptr;
}

void Endoscope::update(const PanelContext& c, double seconds) {
    const bool flew = flies_;
    flies_ = c.core.view.flies;
    if (!flies_) plays_ = false;
    if (flies_ && !flew) {
        abscissa_ = 0.0;
        look_ahead();
    }
    if (flies_) find_paths(c);
    if (!moves()) return;
    advance(kSpeed * std::min(seconds, kLongestFrame));
    if (abscissa_ >= path()->length()) plays_ = false;
}

/// The openings may be known later than the centerlines: these say where flights begin and end.
void Endoscope::find_paths(const PanelContext& c) {
    const auto& graph = c.core.get<ColoursFeature>().view_data().centerlines();
    if (!graph || c.core.searches_places()) return;
    const std::vector<PatchMeasures>& openings = c.core.surface_places().openings;
    if (graph == graph_ && same_openings(openings, openings_)) return;
    graph_ = graph;
    openings_ = openings;
    paths_ = flight_paths(*graph, openings);
    if (chosen_ >= paths_.size()) chosen_ = 0;
    if (path() != nullptr) abscissa_ = std::min(abscissa_, path()->length());
}

std::optional<ViewCamera> Endoscope::camera() const {
    if (path() == nullptr) return std::nullopt;
    const FlightPlace place = place_on(*path(), abscissa_);
    const ViewCamera ahead =
        looking_from(place.eye, place.view, place.up, place.radius, kFieldOfView);
    return looked_round(ahead, right_, up_);
}

void Endoscope::look_round(double right, double up) {
    right_ += right;
    up_ = std::clamp(up_ + up, -kMostUp, kMostUp);
}

void Endoscope::advance(double radii) {
    if (path() == nullptr) return;
    const double radius = place_on(*path(), abscissa_).radius;
    abscissa_ = std::clamp(abscissa_ + radii * radius, 0.0, path()->length());
}

void Endoscope::toggle_play() {
    plays_ = !plays_;
    if (plays_ && path() != nullptr && abscissa_ >= path()->length()) abscissa_ = 0.0;
}

void Endoscope::handle_keys(const KeyCommands& keys) {
    if (keys.has(KeyCommand::FlyOrStop)) toggle_play();
    if (keys.has(KeyCommand::FlyForward)) advance(kKeyStep);
    if (keys.has(KeyCommand::FlyBack)) advance(-kKeyStep);
    if (keys.has(KeyCommand::LookAhead)) look_ahead();
}

void Endoscope::draw_destination(PanelContext& c, float width) {
    std::vector<std::string> names;
    for (const FlightPath& path : paths_)
        names.push_back(std::to_string(names.size() + 1) + "  " + path.name);
    std::string chosen = names[chosen_];
    if (choice(c.ui, "flight.to", names, chosen, width)) {
        chosen_ = static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin());
        abscissa_ = std::min(abscissa_, path()->length());
    }
    help_on_hover(c.ui, "Where the flight ends");
}

void Endoscope::draw_strip(PanelContext& c, ViewStrips& strips) {
    if (!c.core.view.flies) return;
    const Ui& ui = c.ui;
    const float side = ImGui::GetFrameHeight(), gap = ui.grid(0.75F), ends = ui.em * 12.5F;
    const float wide = strips.begin(ui, "flight", ui.em * 34);
    if (path() == nullptr) {
        const ViewData& data = c.core.get<ColoursFeature>().view_data();
        const bool searches = data.finds_centerlines() || c.core.searches_places();
        const std::string words = searches ? "Finding the centerlines"
                                  : !data.centerlines_problem().empty()
                                      ? data.centerlines_problem()
                                      : "No vessel to fly through";
        ImGui::AlignTextToFramePadding();
        clipped_text(ui, words, ui.theme.text, wide - side - gap);
        ImGui::SameLine(0, gap);
    } else {
        if (icon_button(c.ui, "flight.play", plays_ ? icons::kPause : icons::kPlay,
                        plays_ ? "Stop  Space" : "Fly  Space"))
            toggle_play();
        ViewStrips::next(ui);
        const double diameter = 2.0 * place_on(*path(), abscissa_).radius;
        slider(c.ui, "flight.place", abscissa_,
               {.most = path()->length(),
                .text = formatted(abscissa_, "%.1f of ") + formatted(path()->length(), "%.1f mm") +
                        formatted(diameter, "   \u00F8 %.2f mm"),
                .width = wide - ends - 2 * side - 3 * gap,
                .help = "Drag, or turn the wheel in the view; drag the view to look around"});
        ViewStrips::next(ui);
        draw_destination(c, ends);
        ViewStrips::next(ui);
    }
    if (icon_button(c.ui, "flight.close", icons::kClose, "Leave the vessel  E or Esc"))
        c.core.view.flies = false;
}

}  // namespace vesselbench
