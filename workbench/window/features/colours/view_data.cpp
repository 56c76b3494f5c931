#include "workbench/window/features/colours/view_data.h"

#include "geometry/vessel/centerlines/centerlines.h"

namespace vesselbench {

namespace {

bool has_values(ColouringKind kind) {
    return kind != ColouringKind::Patches && kind != ColouringKind::Deviation;
}

bool wants_lines(const ViewChoice& view, const ShownLayers& layers) {
    return layers.centerlines || view.flies || view.tool == ClickTool::Diameter;
}

}  // namespace

ViewData::ViewData(const std::function<void()>& wake) : colours_(wake), lines_(wake) {}

const std::shared_ptr<const CenterlineGraph>& ViewData::centerlines() const {
    static const Lines kNone;
    return lines_.newest() ? *lines_.newest() : kNone;
}

void ViewData::ask_colours(const Document& document, Asked now) {
    if (now == asked_colours_) return;
    asked_colours_ = now;
    colours_.forget();
    if (now.scene < 0) return;
    colours_.start([kind = now.kind, scene = *document.shown()](const Progress& progress) {
        return colour_values(kind, scene, progress);
    });
}

void ViewData::ask_lines(const Document& document, Asked now) {
    if (now == asked_lines_) return;
    asked_lines_ = now;
    lines_.forget();
    if (now.scene < 0) return;
    lines_.start([surface = *document.shown()->surface](const Progress& progress) {
        return centerlines_of(surface, {}, progress);
    });
}

bool ViewData::update(const Document& document, const ViewChoice& view, const ShownLayers& layers) {
    const Scene* scene = document.shown();
    const bool any = scene != nullptr && scene->surface && !scene->surface->empty();
    const int number = any ? document.scene_changes() : -1;
    // A stroke goes on as long as it likes: what was found before it stays until its end.
    if (!any || !document.is_painting()) {
        const bool coloured = any && has_values(view.colouring);
        ask_colours(document, coloured ? Asked{number, view.colouring} : Asked{});
        ask_lines(document, any && wants_lines(view, layers) ? Asked{number} : Asked{});
    }
    const bool colours = colours_.poll(), lines = lines_.poll();
    return colours || lines;
}

}  // namespace vesselbench
