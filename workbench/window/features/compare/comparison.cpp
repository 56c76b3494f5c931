#include "workbench/window/features/compare/comparison.h"

#include <algorithm>
#include <utility>

#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

bool has_triangles(const Scene& scene) {
    return scene.surface && !scene.surface->empty();
}

SceneDifference difference_of(const Scene& reference, const Scene& shown,
                              const Progress& progress) {
    SceneDifference difference{.change = surface_change(reference, shown, progress), .map = {}};
    progress.check_cancelled();
    if (has_triangles(reference) && has_triangles(shown))
        difference.map = std::make_shared<const DeviationMap>(
            deviation_map(*shown.surface, *reference.surface, {}, progress));
    return difference;
}

}  // namespace

Comparison::~Comparison() {
    reading_.cancel();
}

bool Comparison::update(Document& document) {
    bool changed = take_scene();
    changed = take_difference() || changed;
    if (variant_ != document.variant()) read(document);
    if (scene_ && document.shown() != nullptr && measured_scenes_ != document.scene_changes()) {
        measure(document);
        changed = true;
    }
    return changed;
}

void Comparison::read(Document& document) {
    variant_ = document.variant();
    scene_.reset();
    difference_.reset();
    measured_scenes_ = -1;
    reading_ = document.runner()->submit(
        [reference = reference_, variant = variant_](Session& session, const Progress& progress) {
            if (const auto* start = std::get_if<EditStart>(&reference))
                return session.result_scene(start->result, progress);
            return session.known_scene(std::get<StateId>(reference), variant, progress);
        },
        "reference");
}

void Comparison::measure(Document& document) {
    measured_scenes_ = document.scene_changes();
    difference_.reset();
    measuring_.forget();
    measuring_.start([reference = *scene_, shown = *document.shown()](const Progress& progress) {
        return difference_of(reference, shown, progress);
    });
}

bool Comparison::take_scene() {
    if (!reading_.poll()) return false;
    scene_ = reading_.take();
    problem_ = reading_.problem();
    ++scene_changes_;
    return true;
}

bool Comparison::take_difference() {
    if (!measuring_.poll()) return false;
    difference_ = measuring_.take();
    if (!difference_) problem_ = measuring_.problem();
    return true;
}

// --- blinking

void Comparison::set_mode(CompareMode mode) {
    mode_ = mode;
    on_reference_ = true;
    by_hand_ = false;
    switches_at_.reset();
}

void Comparison::switch_by_hand() {
    by_hand_ = true;
    on_reference_ = !on_reference_;
}

void Comparison::blink(double now) {
    if (mode_ != CompareMode::Blink || by_hand_ || !scene_) return;
    if (!switches_at_) switches_at_ = now + kBlinkTime;
    if (now < *switches_at_) return;
    on_reference_ = !on_reference_;
    switches_at_ = now + kBlinkTime;
}

std::optional<double> Comparison::next_blink(double now) const {
    if (mode_ != CompareMode::Blink || by_hand_ || !switches_at_) return std::nullopt;
    return std::max(0.0, *switches_at_ - now);
}

}  // namespace vesselbench
