#include "workbench/window/app/app.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/core/layout.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/borders/borders.h"
#include "workbench/window/features/history/note_dialog.h"
#include "workbench/window/features/history/thumbnails.h"
#include "workbench/window/panels/banners.h"
#include "workbench/window/panels/bottom_panel.h"
#include "workbench/window/panels/file_dialog.h"
#include "workbench/window/panels/help_overlay.h"
#include "workbench/window/panels/leaving_dialog.h"
#include "workbench/window/panels/operation_panel.h"
#include "workbench/window/panels/prepare_dialog.h"
#include "workbench/window/panels/rail_panel.h"
#include "workbench/window/panels/shortcuts.h"
#include "workbench/window/panels/start_screen.h"
#include "workbench/window/panels/status_line.h"
#include "workbench/window/panels/tool_bar.h"
#include "workbench/window/panels/view_panel.h"
#include "workbench/window/view/viewport.h"

namespace vesselbench {

namespace {

constexpr float kTextSize = 15.0F;                          ///< at scale 1 [pixels]
constexpr float kLeastWidth = 53.0F, kLeastHeight = 37.0F;  ///< of a window for its parts [em]

std::filesystem::path or_else(const std::filesystem::path& given,
                              std::filesystem::path (*otherwise)()) {
    return given.empty() ? otherwise() : given;
}

std::filesystem::path cache_of(const AppOptions& options) {
    return or_else(options.cache.empty() ? options.settings : options.cache, cache_folder);
}

DocumentOptions document_options(const AppOptions& options) {
    return {.session = options.session,
            .wake = options.wake,
            .documents = or_else(options.documents, documents_folder)};
}

}  // namespace

struct App::Impl {
    explicit Impl(const AppOptions& options)
        : place(document_options(options), Settings(or_else(options.settings, settings_folder)),
                options.live),
          viewport(options.wake),
          thumbnails(options.wake, cache_of(options)),
          files(options.wake),
          device(options.device),
          display_scale(options.display_scale) {
        if (!options.notice.empty())
            place.document.tell(make_message(MessageKind::Warning, options.notice));
    }

    /// Enlarged no further than the window has room for all of its parts.
    [[nodiscard]] float text_size() const {
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        const float usual = kTextSize * static_cast<float>(display_scale);
        const float room = std::min(size.x / kLeastWidth, size.y / kLeastHeight);
        const float most = std::max(usual, room);
        return std::round(std::min(usual * static_cast<float>(place.settings.scale), most));
    }

    void take_case();
    void unfold_form();
    [[nodiscard]] Layout layout() const;
    void draw_case(PanelContext& context, const Layout& layout);

    Workplace place;
    Ui ui;
    Shown shown;
    Viewport viewport;
    Thumbnails thumbnails;
    FileDialog files;
    int seen_opened = 0;    ///< Document::opened()
    bool had_form = false;  ///< in the last frame
    std::string device;
    double display_scale = 1.0;
    bool moved = true;           ///< the last update changed something
    bool banners_moved = false;  ///< in the last frame
    std::string recovered_from;  ///< the last error of a frame
};

App::App(AppOptions options) : impl_(std::make_unique<Impl>(options)) {}

App::~App() = default;

void App::set_display_scale(double scale) {
    impl_->display_scale = scale;
}

bool App::restyle() {
    Ui& ui = impl_->ui;
    const float em = impl_->text_size();
    const bool dark = impl_->place.settings.dark;
    const bool new_fonts = ui.fonts.regular == nullptr || ui.em != em;
    if (!new_fonts && ui.theme.dark == dark) return false;
    ui.theme = dark ? dark_theme() : light_theme();
    if (new_fonts) {
        ui.em = em;
        ui.fonts = make_fonts(em);
    }
    apply_theme(ui.theme, em);
    return new_fonts;
}

/// What was typed for a case ends with it. An opening that fails or is cancelled ends none.
void App::Impl::take_case() {
    if (std::exchange(seen_opened, place.document.opened()) == place.document.opened()) return;
    shown.prepare = false;
    shown.note.reset();
    shown.leaving = Leaving::Nothing;
    shown.enlarged = Enlarged::None;
}

/// A form that is opened is seen.
void App::Impl::unfold_form() {
    const bool has_form = place.form().has_value();
    if (has_form && !std::exchange(had_form, has_form))
        place.settings.panels[Panel::Operation].folded = false;
    had_form = has_form;
}

Layout App::Impl::layout() const {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    PanelSizes sizes = place.settings.panels;
    if (shown.enlarged != Enlarged::None) sizes[Panel::Bottom].folded = true;
    return layout_of(size.x, size.y, ui.em, sizes);
}

void App::Impl::draw_case(PanelContext& context, const Layout& layout) {
    viewport.draw(context, layout.view);
    if (layout.rail.width > 0) draw_rail(context, layout.rail);
    if (layout.operation.width > 0) draw_operation_panel(context, layout.operation);
    if (layout.bottom.height > 0) draw_bottom_panel(context, layout.bottom);
    for (const Border& border : layout.borders) draw_border(context, border);
    const float end = draw_banners(context, Viewport::model_part(context, layout.view));
    banners_moved = std::exchange(shown.banners_end, end) != end;  // what lies below them follows
    draw_view_panel(context, layout.view);
}

void App::draw() {
    Impl& app = *impl_;
    app.moved = app.place.update();
    app.take_case();
    app.thumbnails.update(app.place.document, app.viewport.renderer());
    app.ui.begin_frame();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    app.unfold_form();
    const Layout layout = app.layout();
    app.shown.compact = layout.compact;
    PanelContext context{
        app.ui,        app.place,
        app.place,     app.shown,
        app.device,    [](const std::string& text) { ImGui::SetClipboardText(text.c_str()); },
        app.thumbnails};
    handle_shortcuts(context);
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, size, app.ui.theme.border);
    draw_tool_bar(context, layout.tool_bar);
    if (app.place.document.is_open()) {
        app.draw_case(context, layout);
    } else {
        const float top = layout.rail.y;
        app.viewport.rest(context);
        draw_start_screen(context, {0, top, size.x, layout.rail.height});
    }
    draw_status_line(context, layout.status);
    app.files.draw(context, layout.window);
    const bool asks = app.place.question() != FileQuestion::None;  // where to save the recipe
    if (app.shown.prepare && app.place.document.is_open() && !asks)
        draw_prepare_dialog(context, layout.window);
    if (app.shown.note && app.place.document.is_open()) draw_note_dialog(context, layout.window);
    if (app.shown.help) draw_help_overlay(context, layout.window);
    draw_leaving_dialog(context, layout.window);
}

void App::recover(const std::string& error) {
    Impl& app = *impl_;
    app.shown.prepare = app.shown.help = false;
    app.shown.note.reset();
    app.shown.leaving = Leaving::Nothing;
    app.place.ask(FileQuestion::None);
    app.place.leave_form();
    if (std::exchange(app.recovered_from, error) != error)
        app.place.document.tell(make_message(MessageKind::Error, "the window failed: " + error));
}

bool App::may_close() {
    if (!impl_->shown.closes) leave(impl_->place, impl_->shown, Leaving::Window);
    return impl_->shown.closes;
}

bool App::closes() const {
    return impl_->shown.closes;
}

bool App::is_moving() const {
    return impl_->moved || impl_->banners_moved || impl_->place.pending() ||
           impl_->viewport.pending() || impl_->thumbnails.pending() || impl_->files.pending();
}

std::optional<double> App::next_change() const {
    const auto& comparison = impl_->place.comparison();
    return comparison ? comparison->next_blink(ImGui::GetTime()) : std::nullopt;
}

bool App::is_settled() const {
    return !is_moving();
}

void App::rest() {
    impl_->moved = impl_->place.update();
}

void App::open(const std::filesystem::path& path) {
    impl_->shown.help = impl_->shown.prepare = false;
    impl_->place.ask(FileQuestion::None);
    impl_->place.open(path);
}

void App::drop(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    open(files.front());
    if (files.size() == 1) return;
    impl_->place.document.tell(
        make_message(MessageKind::Warning, counted(files.size(), "file") + " were dropped; " +
                                               files.front().filename().string() +
                                               " is opened: the window shows one case at a time"));
}

int App::drawings() const {
    return impl_->viewport.drawings();
}

const ViewCamera& App::camera() const {
    return impl_->viewport.camera();
}

Workplace& App::place() {
    return impl_->place;
}

const Ui& App::ui() const {
    return impl_->ui;
}

std::string App::title() const {
    const Document& document = impl_->place.document;
    if (!document.is_open()) return "vesselbench";
    return document.project().filename().string() + " \u2013 vesselbench";
}

}  // namespace vesselbench
