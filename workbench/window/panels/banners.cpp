#include "workbench/window/panels/banners.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/model/readable.h"
#include "workbench/window/model/remedies.h"
#include "workbench/window/panels/comparison_banner.h"
#include "workbench/window/panels/message_panel.h"
#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/panels/unit_banner.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/view/gallery_view.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

/// A line over the view: an icon, a text, and at its end up to two buttons.
struct Banner {
    const char* icon;
    Paint colour = 0;
    std::string text;
    std::string action = {};  ///< label of the button
    bool can_close = false;
    bool is_next = false;  ///< the action is what most users want
};

/// What a banner's buttons take at its end.
float width_of_buttons(const Ui& ui, const Banner& banner) {
    const float action =
        banner.action.empty() ? 0 : ImGui::CalcTextSize(banner.action.c_str()).x + ui.grid(4);
    return action + (banner.can_close ? ImGui::GetFrameHeight() + ui.grid(1) : 0);
}

enum class Answer { None, Action, Close };

Answer draw_banner(PanelContext& c, const std::string& name, const Banner& banner,
                   const ScreenRect& rect) {
    const Ui& ui = c.ui;
    begin_frame(ui, "banner." + name, rect,
                {.back = ui.theme.raised,
                 .padding = ui.grid(1),
                 .scrolls = false,
                 .floats = true,
                 .bordered = true});
    ImGui::AlignTextToFramePadding();
    text(ui, banner.icon, banner.colour);
    ImGui::SameLine();
    const float end = rect.width - ui.grid(1) - width_of_buttons(ui, banner);
    ImGui::PushTextWrapPos(end);
    text(ui, broken(banner.text, end - ImGui::GetCursorPosX()), ui.theme.text);
    ImGui::PopTextWrapPos();
    Answer answer = Answer::None;
    ImGui::SetCursorPos({end + ui.grid(1), ui.grid(1)});
    if (!banner.action.empty() &&
        button(c.ui, "banner." + name + ".action", banner.action, {.primary = banner.is_next}))
        answer = Answer::Action;
    ImGui::SetCursorPos({rect.width - ui.grid(1) - ImGui::GetFrameHeight(), ui.grid(1)});
    if (banner.can_close && icon_button(c.ui, "banner." + name + ".close", icons::kClose, "Close"))
        answer = Answer::Close;
    end_frame();
    return answer;
}

/// Tall enough for its text.
float height_of(const Ui& ui, const Banner& banner, float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float icon = ImGui::CalcTextSize(banner.icon).x + style.ItemSpacing.x;
    const float room = width - 2 * ui.grid(1) - icon - width_of_buttons(ui, banner);
    const std::string lines = broken(banner.text, room);
    const float text = ImGui::CalcTextSize(lines.c_str(), nullptr, false, room).y;
    return text + 2 * style.FramePadding.y + 2 * ui.grid(1);
}

/// In whole pixels: the view's framebuffer has no others.
void take_off(ScreenRect& left, float height) {
    const float taken = std::ceil(left.y + height) - left.y;
    left.y += taken;
    left.height = std::max(left.height - taken, 1.0F);
}

/// \param left of the view: the banner takes its top
Answer draw_top(PanelContext& c, const std::string& name, const Banner& banner, ScreenRect& left) {
    ScreenRect place = left;
    place.height = height_of(c.ui, banner, place.width);
    c.ui.item("banner." + name, place);
    const Answer answer = draw_banner(c, name, banner, place);
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
    const Answer answer = draw_banner(c, "failure", banner, place);
    if (answer == Answer::None) return;
    c.place.document.forget_failure();
    if (answer == Answer::Action) follow(c.place, failure);
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
    if (draw_top(c, "pending", banner, left) == Answer::Action) c.place.document.run_pending();
}

void draw_read_only(PanelContext& c, ScreenRect& left) {
    const Banner banner{icons::kWarning, c.ui.theme.warning,
                        c.place.document.snapshot()->read_only_reason,
                        c.place.document.can(RequestKind::Output) ? "Save a copy" : ""};
    if (draw_top(c, "read_only", banner, left) == Answer::Action)
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
    if (draw_top(c, "input", banner, left) == Answer::Action) c.place.leave_form();
}

void draw_made_before(PanelContext& c, ScreenRect& left) {
    Document& document = c.place.document;
    const Banner banner{icons::kInformation, c.ui.theme.accent,
                        "This project was made from " + document.made_before()->name() +
                            " before; it is opened as you left it",
                        "Start a new project", true};
    const Answer answer = draw_top(c, "made_before", banner, left);
    if (answer == Answer::Action) return document.begin_anew();
    if (answer == Answer::Close) document.keep_made_before();
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
    if (draw_top(c, "stale", banner, left) == Answer::Action) c.place.choose_edit(edit);
}

void draw_preview(PanelContext& c, ScreenRect& place) {
    const Banner banner{icons::kPreview, c.ui.theme.accent,
                        "Preview of " + readable(c.place.document.previewed()->edit().operation) +
                            ": not applied yet"};
    place.height = height_of(c.ui, banner, place.width);
    draw_banner(c, "preview", banner, place);
}

std::string figures_of(const LiveModel& model) {
    const auto& change = model.state.change;
    if (!change) return "";
    return "Vertices are displaced from the previous surface by " + formatted(change->error.mean) +
           " mm on average, at most " + formatted(change->error.largest) + " mm; volume " +
           formatted(change->volume_change_percent, "%+.2f %%") + "; normal curvature " +
           formatted(change->normal_curvature_before_deg) + " to " +
           formatted(change->normal_curvature_after_deg) + " deg";
}

/// What is shown is not all of what is asked for.
std::string progress_of(const LiveModel& model) {
    const auto& state = model.state;
    if (state.whole) return "";
    return "Coarse: " + std::to_string(state.iterations) + " of " +
           std::to_string(state.resolved.integer("iterations")) + " iterations";
}

std::string live_text(const PanelContext& c) {
    const LiveSmoothing& live = c.place.live();
    const auto& model = live.shown();
    if (!live.problem().empty()) return readable_sentence(live.problem());
    if (!model) return "Finding what the smoothing depends on";
    std::string text = "Live preview, not applied yet";
    for (const std::string& more : {progress_of(*model), figures_of(*model)})
        if (!more.empty()) text += ". " + more;
    return text;
}

void draw_live(PanelContext& c, ScreenRect& place) {
    const bool failed = !c.place.live().problem().empty();
    const Banner banner{failed ? icons::kWarning : icons::kPreview,
                        failed ? c.ui.theme.warning : c.ui.theme.accent, live_text(c), "", true};
    place.height = height_of(c.ui, banner, place.width);
    c.ui.item("banner.live", place);
    if (draw_banner(c, "live", banner, place) == Answer::Close) c.place.live().follow(false);
}

std::string extraction_text(const PanelContext& c) {
    const LiveExtraction& extraction = c.place.extraction();
    if (!extraction.problem().empty()) return readable_sentence(extraction.problem());
    if (!extraction.shown()) return "Extracting the surface";
    return extraction.outdated() ? "Live preview, coarse" : "Live preview, not applied yet";
}

/// No wider than its words: the slices leave the view little height, and the vessel is seen beside
/// it.
void draw_extraction(PanelContext& c, ScreenRect& place) {
    const bool failed = !c.place.extraction().problem().empty();
    const Banner banner{failed ? icons::kWarning : icons::kPreview,
                        failed ? c.ui.theme.warning : c.ui.theme.accent, extraction_text(c), "",
                        true};
    const float wide = ImGui::CalcTextSize(banner.text.c_str()).x + c.ui.em * 7;
    const float spare = std::max(place.width - wide, 0.0F);
    place.x += spare;
    place.width -= spare;
    place.height = height_of(c.ui, banner, place.width);
    c.ui.item("banner.live", place);
    if (draw_banner(c, "live", banner, place) == Answer::Close) c.place.follow_extraction(false);
}

/// Below the view's buttons: the magnified spots leave no room beside them.
ScreenRect beside_spots(const Ui& ui, const ScreenRect& view, float gap) {
    return {view.x + gap, view.y + 2 * gap + ImGui::GetFrameHeight() + ui.grid(1),
            view.width - magnified_width(view) - 2 * gap, 0};
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

void draw_banners(PanelContext& c, const ScreenRect& view) {
    const Document& document = c.place.document;
    if (!document.is_open()) return;
    const float gap = c.ui.grid(1.5F);
    const float tools = c.ui.em * 19.5F;  // the view's buttons
    ScreenRect place{view.x + tools, view.y + gap, view.width - tools - gap, 0};
    if (c.place.gallery().mode() == GalleryMode::Spots) place = beside_spots(c.ui, view, gap);
    if (document.failure() && !is_about_form(c)) {
        draw_failure(c, place);
        place.y += place.height + gap;
    }
    if (c.place.comparison()) {
        place.height = comparison_banner_height(c.ui);
        draw_comparison_banner(c, place);
        place.y += place.height + gap;
    }
    if (c.place.gallery().mode() == GalleryMode::Models) return;  // what they say is not seen
    if (document.previewed())
        draw_preview(c, place);
    else if (c.place.live().follows())
        draw_live(c, place);
    else if (c.place.extraction().follows())
        draw_extraction(c, place);
}

}  // namespace vesselbench
