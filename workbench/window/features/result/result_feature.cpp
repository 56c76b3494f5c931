#include "workbench/window/features/result/result_feature.h"

#include "workbench/case/purposes.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/features/compare/compare_feature.h"

namespace vesselbench {

void ResultFeature::forget() {
    seen_made_ = core_.document.made_models();
    waits_ = false;
    measuring_.forget();
    close();
}

bool ResultFeature::is_shown(const MadeModel& made) const {
    const Document& document = core_.document;
    return document.is_open() && document.variant() == made.variant &&
           document.snapshot()->history->current() == made.state;
}

const ResultCard* ResultFeature::card() const {
    const auto& made = core_.document.made();
    return card_ && made && is_shown(*made) ? &*card_ : nullptr;
}

bool ResultFeature::update() {
    if (seen_made_ != core_.document.made_models()) {
        seen_made_ = core_.document.made_models();
        measuring_.forget();
        close();
        waits_ = core_.document.made().has_value();
    }
    if (waits_ && core_.document.made()) measure();
    if (!measuring_.poll()) return false;
    if (const auto figures = measuring_.take()) take(*figures);
    return true;
}

/// As soon as the model is read, unless another one is shown meanwhile.
void ResultFeature::measure() {
    const MadeModel& made = *core_.document.made();
    const bool shown = is_shown(made);
    const Scene* scene = core_.document.newest();
    waits_ = shown && (scene == nullptr || core_.document.is_reading());
    if (waits_ || !shown) return;
    measuring_.start([before = made.before, after = *scene](const Progress& progress) {
        return Figures(before ? result_figures(*before, progress) : std::nullopt,
                       result_figures(after, progress));
    });
    core_.document.forget_made_before();
}

void ResultFeature::take(const Figures& figures) {
    const auto& made = core_.document.made();
    if (!made || !figures.second) return;
    const std::size_t warnings = warning_count(*core_.document.snapshot(), made->variant);
    card_ = ResultCard{.model = model_title(made->variant),
                       .what = made->what,
                       .rows = result_rows(figures.first, *figures.second),
                       .warnings = warnings,
                       .can_compare = figures.first.has_value() && made->from != made->state};
    card_->rows.push_back({"Warnings", figures.first ? std::to_string(made->warnings_before) : "",
                           std::to_string(warnings)});
}

void ResultFeature::look() {
    const ResultCard* shown = card();
    if (shown == nullptr) return;
    if (shown->can_compare)
        core_.get<CompareFeature>().compare(core_.document.made()->from);
    else
        core_.frame_model();
}

}  // namespace vesselbench
