#include "workbench/window/panels/banners.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"
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

/// In whole pixels: the view's framebuffer has no others.
void take_off(ScreenRect& left, float height) {
    const float taken = std::ceil(left.y + height) - left.y;
    left.y += taken;
    left.height = std::max(left.height - taken, 1.0F);
}

/// \param left of the view: the banner takes its top
BannerAnswer draw_top(PanelContext& c, const std::string& name, const Banner& banner,
                      ScreenRect& left) {
    ScreenRect place = left;
    place.height = height_of(c.ui, banner, place.width);
    c.ui.item("banner." + name, place);
    const BannerAnswer answer = draw_banner(c.ui, name, banner, place);
    take_off(left, place.height);
    return answer;
}

bool is_about_form(const PanelContext& c) {
    return c.place.form().has_value();
}

void draw_failure(PanelContext& c, ScreenRect& place) {
    const Message failure = *c.place.document.failure();
    const Banner banner{icon_of(failure.kind), c.ui.theme.danger, failure.text,
                        button_of(c.place.document, failure), true};
    place.height = height_of(c.ui, banner, place.width);
    const BannerAnswer answer = draw_banner(c.ui, "failure", banner, place);
    if (answer == BannerAnswer::None) return;
    c.place.document.forget_failure();
    if (answer == BannerAnswer::Action) follow(c.core, failure);
}

void draw_pending(PanelContext& c, ScreenRect& left) {
    const int count = pending_count(*c.place.document.snapshot(), c.place.document.variant());
    if (count == 0) return;
    const Banner banner{icons::kPending,
                        c.ui.theme.accent,
                        counted(static_cast<std::size_t>(count), "edit") +
                            (count == 1 ? " is pending: the model shown is the one before it"
                                        : " are pending: the model shown is the one before them"),
                        c.place.document.can(RequestKind::Edit) ? "Run" : "",
                        false,
                        true};
    if (draw_top(c, "pending", banner, left) == BannerAnswer::Action)
        c.place.document.run_pending();
}

void draw_read_only(PanelContext& c, ScreenRect& left) {
    const Banner banner{icons::kWarning, c.ui.theme.warning,
                        c.place.document.snapshot()->read_only_reason,
                        c.place.document.can(RequestKind::Output) ? "Save a copy" : ""};
    if (draw_top(c, "read_only", banner, left) == BannerAnswer::Action)
        c.place.ask(FileQuestion::SaveCopy);
}

/// Which model is shown while the form of an edit is open that does not run on the newest one.
void draw_input(PanelContext& c, ScreenRect& left) {
    const Document& document = c.place.document;
    const EditInput* input = document.stands_before();
    if (input == nullptr || !c.place.form()) return;
    const std::string model = input_text(*input, c.place.form()->operation().name);
    const Banner banner{icons::kHistory, c.ui.theme.accent,
                        document.is_reading() ? "Reading: " + model : model, "Newest model"};
    if (draw_top(c, "input", banner, left) == BannerAnswer::Action) c.place.leave_form();
}

void draw_made_before(PanelContext& c, ScreenRect& left) {
    Document& document = c.place.document;
    const Banner banner{icons::kInformation, c.ui.theme.accent,
                        "This project was made from " + document.made_before()->name() +
                            " before; it is opened as you left it",
                        "Start a new project", true};
    const BannerAnswer answer = draw_top(c, "made_before", banner, left);
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

void draw_stale(PanelContext& c, ScreenRect& left) {
    const LogEntry* stale = stale_edit(c);
    if (stale == nullptr) return;
    const EditId edit = stale->edit.edit.id;
    const Banner banner{icons::kStale, c.ui.theme.danger,
                        readable(stale->edit.operation) +
                            " no longer applies and was skipped: " + reason_of(*stale),
                        "Change it"};
    if (draw_top(c, "stale", banner, left) == BannerAnswer::Action) c.place.choose_edit(edit);
}

void draw_preview(PanelContext& c, ScreenRect& place) {
    const Banner banner{icons::kPreview, c.ui.theme.accent,
                        "Preview of " + readable(c.place.document.previewed()->edit().operation) +
                            ": not applied yet"};
    place.height = height_of(c.ui, banner, place.width);
    draw_banner(c.ui, "preview", banner, place);
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

}  // namespace

ScreenRect draw_banner_strip(PanelContext& c, const ScreenRect& view) {
    const Document& document = c.place.document;
    ScreenRect left = view;
    if (!document.is_open()) return left;
    if (!document.snapshot()->read_only_reason.empty())
        draw_read_only(c, left);
    else if (c.place.unit_question())
        take_off(left, draw_unit_banner(c, left));
    if (document.made_before()) draw_made_before(c, left);
    draw_input(c, left);
    draw_stale(c, left);
    draw_pending(c, left);
    return left;
}

float draw_banners(PanelContext& c, const ScreenRect& model) {
    const Document& document = c.place.document;
    if (!document.is_open()) return 0;
    const float gap = c.ui.grid(1.5F);
    ScreenRect place = banner_place(c, model);
    const float top = place.y;
    if (document.failure() && !is_about_form(c)) {
        draw_failure(c, place);
        place.y += place.height + gap;
    }
    // What others say is not seen while whole models are shown.
    const bool whole = c.place.gallery().mode() == GalleryMode::Models;
    for (const auto& feature : c.place.features.all()) {
        const float height = whole ? 0.0F : feature->banner(c, place);
        if (height > 0.0F) place.y += height + gap;
    }
    if (document.previewed() && !whole) {
        draw_preview(c, place);
        place.y += place.height + gap;
    }
    return place.y > top ? place.y - gap : 0;
}

}  // namespace vesselbench
