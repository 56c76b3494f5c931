#include "workbench/window/shell/offscreen_shell.h"

#include <ctime>
#include <optional>
#include <thread>

#include <epoxy/gl.h>
#include <imgui.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"
#include "gpu/context.h"
#include "gpu/objects.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/shell/drawing_session.h"

namespace vesselbench {

namespace {

constexpr float kFrameTime = 1.0F / 60;  ///< that passes for ImGui [s]

Renderbuffer colour_buffer(int width, int height) {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    return Renderbuffer(id);
}

Framebuffer framebuffer_of(const Renderbuffer& colour) {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.id());
    return Framebuffer(id);
}

/// ImGui's keys by our numbers.
void set_key_map(ImGuiIO& io) {
    const std::pair<int, int> map[] = {
        {ImGuiKey_Tab, keys::kTab},           {ImGuiKey_LeftArrow, keys::kLeft},
        {ImGuiKey_RightArrow, keys::kRight},  {ImGuiKey_UpArrow, keys::kUp},
        {ImGuiKey_DownArrow, keys::kDown},    {ImGuiKey_PageUp, keys::kPageUp},
        {ImGuiKey_PageDown, keys::kPageDown}, {ImGuiKey_Home, keys::kHome},
        {ImGuiKey_End, keys::kEnd},           {ImGuiKey_Insert, keys::kInsert},
        {ImGuiKey_Delete, keys::kDelete},     {ImGuiKey_Backspace, keys::kBackspace},
        {ImGuiKey_Space, keys::kSpace},       {ImGuiKey_Enter, keys::kEnter},
        {ImGuiKey_Escape, keys::kEscape},     {ImGuiKey_KeyPadEnter, keys::kPadEnter},
        {ImGuiKey_A, keys::letter('A')},      {ImGuiKey_C, keys::letter('C')},
        {ImGuiKey_V, keys::letter('V')},      {ImGuiKey_X, keys::letter('X')},
        {ImGuiKey_Y, keys::letter('Y')},      {ImGuiKey_Z, keys::letter('Z')}};
    for (const auto& [key, number] : map) io.KeyMap[key] = number;
}

OffscreenContext window_context() {
    try {
        return OffscreenContext();
    } catch (const GpuUnavailable& error) {
        throw GpuUnavailable(std::string("the window needs OpenGL 4.3: ") + error.what() +
                             "; the command line works without it (vesselbench --help)");
    }
}

/// Seconds that this thread has worked.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

struct OffscreenShell::Impl {
    Impl(AppOptions options, int width, int height, DebugReport report)
        : debug(report ? std::make_unique<DebugOutput>(std::move(report)) : nullptr),
          colour(colour_buffer(width, height)),
          frame_buffer(framebuffer_of(colour)) {
        set_key_map(ImGui::GetIO());
        ImGui::GetIO().MousePos = {-1e4F, -1e4F};
        set_size(width, height);
        if (options.device.empty()) options.device = checked_device();
        app.emplace(std::move(options));
    }

    void set_size(int width, int height) {
        ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    }

    OffscreenContext context = window_context();
    std::unique_ptr<DebugOutput> debug;
    DrawingSession drawing;
    Renderbuffer colour;
    Framebuffer frame_buffer;
    std::optional<App> app;
    std::function<void(const FrameTime&)> watch;
};

OffscreenShell::OffscreenShell(AppOptions options, int width, int height, DebugReport report)
    : impl_(std::make_unique<Impl>(std::move(options), width, height, std::move(report))) {}

OffscreenShell::~OffscreenShell() = default;

App& OffscreenShell::app() {
    return *impl_->app;
}

void OffscreenShell::frame() {
    const Stopwatch clock;
    const double start = thread_seconds();
    ImGui::GetIO().DeltaTime = kFrameTime;
    impl_->drawing.draw(*impl_->app);
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->frame_buffer.id());
    impl_->drawing.render();
    // As a window's swap does: a driver would queue frames without end, and one would pay for all.
    glFinish();
    ImGui::GetIO().MouseWheel = 0;
    if (impl_->watch) impl_->watch({clock.seconds(), thread_seconds() - start});
}

void OffscreenShell::watch_frames(std::function<void(const FrameTime&)> watch) {
    impl_->watch = std::move(watch);
}

bool OffscreenShell::run_until(const std::function<bool()>& condition,
                               std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (true) {
        frame();
        if (condition()) return true;
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

bool OffscreenShell::settle(std::chrono::milliseconds time) {
    const bool settled = run_until([&] { return app().is_settled(); }, time);
    frame();
    return settled;
}

Picture OffscreenShell::picture() const {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    Picture picture{.width = static_cast<int>(size.x), .height = static_cast<int>(size.y)};
    const std::size_t row = static_cast<std::size_t>(picture.width) * 3;
    std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(picture.height));
    glBindFramebuffer(GL_FRAMEBUFFER, impl_->frame_buffer.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
    for (int y = picture.height; y-- > 0;) {
        const auto from = upward.begin() + static_cast<std::ptrdiff_t>(row) * y;
        picture.rgb.insert(picture.rgb.end(), from, from + static_cast<std::ptrdiff_t>(row));
    }
    return picture;
}

void OffscreenShell::resize(int width, int height) {
    impl_->colour = colour_buffer(width, height);
    impl_->frame_buffer = framebuffer_of(impl_->colour);
    impl_->set_size(width, height);
}

void OffscreenShell::move_mouse(float x, float y) {
    ImGui::GetIO().MousePos = {x, y};
    frame();
}

void OffscreenShell::press(MouseButton button) {
    ImGui::GetIO().MouseDown[static_cast<int>(button)] = true;
    frame();
}

void OffscreenShell::release(MouseButton button) {
    ImGui::GetIO().MouseDown[static_cast<int>(button)] = false;
    frame();
}

void OffscreenShell::click(float x, float y) {
    move_mouse(x, y);
    press(MouseButton::Left);
    release(MouseButton::Left);
    frame();
}

void OffscreenShell::wheel(float notches) {
    ImGui::GetIO().MouseWheel = notches;
    frame();
}

void OffscreenShell::drag(float from_x, float from_y, float to_x, float to_y, MouseButton button,
                          HeldKeys held) {
    constexpr int kMoves = 8;
    move_mouse(from_x, from_y);
    ImGui::GetIO().KeyCtrl = held.control;
    ImGui::GetIO().KeyShift = held.shift;
    press(button);
    for (int i = 1; i <= kMoves; ++i) {
        const float share = static_cast<float>(i) / kMoves;
        move_mouse(from_x + share * (to_x - from_x), from_y + share * (to_y - from_y));
    }
    release(button);
    ImGui::GetIO().KeyCtrl = ImGui::GetIO().KeyShift = false;
}

void OffscreenShell::type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frame();
}

void OffscreenShell::press_key(int key, HeldKeys held) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = held.control;
    io.KeyShift = held.shift;
    io.KeysDown[key] = true;
    frame();
    io.KeysDown[key] = false;
    io.KeyCtrl = io.KeyShift = false;
    frame();
}

bool OffscreenShell::has(const std::string& item) {
    frame();
    return impl_->app->ui().items().contains(item);
}

bool OffscreenShell::click_item(const std::string& item) {
    if (!has(item)) return false;
    const UiItem found = impl_->app->ui().items().at(item);
    if (found.enabled) click(found.rect.middle_x(), found.rect.middle_y());
    return found.enabled;
}

bool OffscreenShell::fill_item(const std::string& item, const std::string& text) {
    if (!click_item(item)) return false;
    press_key(keys::letter('A'), {.control = true});
    if (text.empty()) press_key(keys::kDelete);
    type(text);
    frame();
    return true;
}

}  // namespace vesselbench
