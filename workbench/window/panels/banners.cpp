#include "workbench/window/panels/banners.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/case/rerun.h"
#include "workbench/window/core/layout.h"
#include "workbench/window/core/remedies.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/drawing/view_overlays.h"
#include "workbench/window/features/gallery/gallery_view.h"
#include "workbench/window/panels/message_panel.h"
#include "workbench/window/panels/unit_banner.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/banner.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

/// Under a banner comes the next one.
void step_below(const PanelContext& c, ScreenRect& place, float height) {
    place.y += height + c.ui.grid(1.5F);
}

/// No wider than its text, at the end, so that little of the model is covered.
/// \param place whose top the banner takes; then that of the next one
BannerAnswer draw_next(PanelContext& c, const std::string& name, const Banner& banner,
                       ScreenRect& place) {
    ScreenRect own = place;
    own.width = std::min(std::ceil(width_of(c.ui, banner)), place.width);
    own.x += place.width - own.width;
    own.height = height_of(c.ui, banner, own.width);
    c.ui.item("banner." + name, own);
    const BannerAnswer answer = draw_banner(c.ui, name, banner, own);
    step_below(c, place, own.height);
    return answer;
}

bool is_about_form(const PanelContext& c) {
    return c.place.form().has_value();
}

void draw_failure(PanelContext& c, ScreenRect& place) {
    const Message failure = *c.place.document.failure();
    const Banner banner{icon_of(failure.kind), c.ui.theme.danger, failure.text,
                        button_of(c.place.document, failure), true};
    const BannerAnswer answer = draw_next(c, "failure", banner, place);
    if (answer == BannerAnswer::None) return;
    c.place.document.forget_failure();
    if (answer == BannerAnswer::Action) follow(c.core, failure);
}

void draw_pending(PanelContext& c, ScreenRect& place) {
    const Rerun rerun = pending_rerun(*c.place.document.snapshot(), c.place.document.variant());
    if (rerun.edits == 0) return;
    const bool explained = c.place.document.stands_before() != nullptr && c.place.form();
    const std::string shown_model =
        std::string(". The model shown is the one before ") + (rerun.edits == 1 ? "it" : "them");
    const Banner banner{icons::kPending,
                        c.ui.theme.accent,
                        "Pending: " + rerun_text(rerun) + (explained ? "" : shown_model),
                        c.place.document.can(RequestKind::Edit) ? "Run" : "",
                        false,
                        true};
    if (draw_next(c, "pending", banner, place) == BannerAnswer::Action)
        c.place.document.run_pending();
}

void draw_read_only(PanelContext& c, ScreenRect& place) {
    const Banner banner{icons::kWarning, c.ui.theme.warning,
                        c.place.document.snapshot()->read_only_reason,
                        c.place.document.can(RequestKind::Output) ? "Save a copy" : ""};
    if (draw_next(c, "read_only", banner, place) == BannerAnswer::Action)
        c.place.ask(FileQuestion::SaveCopy);
}

/// Which model is shown while the form of an edit is open that does not run on the newest one.
void draw_input(PanelContext& c, ScreenRect& place) {
    const Document& document = c.place.document;
    const EditInput* input = document.stands_before();
    if (input == nullptr || !c.place.form()) return;
    const std::string model = input_text(*input, c.place.form()->operation().name);
    const Banner banner{icons::kHistory, c.ui.theme.accent,
                        document.is_reading() ? "Reading: " + model : model, "Newest model"};
    if (draw_next(c, "input", banner, place) == BannerAnswer::Action) c.place.leave_form();
}

void draw_made_before(PanelContext& c, ScreenRect& place) {
    Document& document = c.place.document;
    const Banner banner{icons::kInformation, c.ui.theme.accent,
                        "This project was made from " + document.made_before()->name() +
                            " before; it is opened as you left it",
                        "Start a new project", true};
    const BannerAnswer answer = draw_next(c, "made_before", banner, place);
    if (answer == BannerAnswer::Action) return document.begin_anew();
    if (answer == BannerAnswer::Close) document.keep_made_before();
}

/// The first edit of the shown variant that no longer applies, unless its form is open.
const LogEntry* stale_edit(const PanelContext& c) {
    const auto& form = c.place.form();
    const LogEntry* stale = first_stale(*c.place.document.snapshot(), c.place.document.variant());
    const bool open = stale != nullptr && form && form->edit() == stale->edit.edit.id;
    return open ? nullptr : stale;
}

void draw_stale(PanelContext& c, ScreenRect& place) {
    const LogEntry* stale = stale_edit(c);
    if (stale == nullptr) return;
    const EditId edit = stale->edit.edit.id;
    const Banner banner{icons::kStale, c.ui.theme.danger,
                        readable(stale->edit.operation) +
                            " no longer applies and was skipped: " + reason_of(*stale),
                        "Change it"};
    if (draw_next(c, "stale", banner, place) == BannerAnswer::Action) c.place.choose_edit(edit);
}

void draw_preview(PanelContext& c, ScreenRect& place) {
    const Banner banner{icons::kPreview, c.ui.theme.accent,
                        "Preview of " + readable(c.place.document.previewed()->edit().operation) +
                            ": not applied yet"};
    draw_next(c, "preview", banner, place);
}

/// A banner narrower than this is put below the view's buttons [em].
constexpr float kLeastBanner = 20.0F;

/// Beside the view's buttons, or below them where no room is left for its text.
ScreenRect banner_place(const PanelContext& c, const ScreenRect& model) {
    const float gap = c.ui.grid(1.5F);
    const bool spots = c.place.gallery().mode() == GalleryMode::Spots;
    const float end = model.x + model.width - (spots ? magnified_width(model) : 0.0F) - gap;
    const ScreenRect tools = tool_grid(c.ui, model).rect;
    const float beside = tools.x + tools.width + gap;
    if (end - beside >= kLeastBanner * c.ui.em) return {beside, tools.y, end - beside, 0};
    return {model.x + gap, tools.y + tools.height + gap, end - model.x - gap, 0};
}

/// What stays for a while: which model is shown, pending edits and those that no longer apply,
/// questions about the project.
void draw_lasting(PanelContext& c, ScreenRect& place) {
    const Document& document = c.place.document;
    if (!document.snapshot()->read_only_reason.empty())
        draw_read_only(c, place);
    else if (c.place.unit_question())
        step_below(c, place, draw_unit_banner(c, place));
    if (document.made_before()) draw_made_before(c, place);
    draw_input(c, place);
    draw_stale(c, place);
    draw_pending(c, place);
}

/// What others say is not seen while whole models are shown.
void draw_passing(PanelContext& c, ScreenRect& place) {
    const Document& document = c.place.document;
    if (document.failure() && !is_about_form(c)) draw_failure(c, place);
    if (c.place.gallery().mode() == GalleryMode::Models) return;
    for (const auto& feature : c.place.features.all())
        if (const float height = feature->banner(c, place); height > 0.0F)
            step_below(c, place, height);
    if (document.previewed()) draw_preview(c, place);
}

}  // namespace

float draw_banners(PanelContext& c, const ScreenRect& model) {
    if (!c.place.document.is_open()) return 0;
    ScreenRect place = banner_place(c, model);
    const float top = place.y;
    draw_lasting(c, place);
    // A case that a banner's button closes has no more to say.
    if (c.place.document.is_open()) draw_passing(c, place);
    return place.y > top ? place.y - c.ui.grid(1.5F) : 0;
}

}  // namespace vesselbench
