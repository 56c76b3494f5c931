#include "workbench/window/shell/glfw_shell.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

// GLFW must not include OpenGL's headers itself.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include "geometry/kernel/errors.h"
#include "gpu/debug_output.h"
#include "workbench/window/shell/drawing_session.h"
#include "workbench/window/shell/key_layout.h"

namespace vesselbench {

namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr double kProgressInterval = 0.1;  ///< between frames while something runs [s]
constexpr double kShortestWait = 0.001;    ///< for a change whose time has come [s]
constexpr int kFramesAfterInput = 3;       ///< until ImGui shows everything that input caused

/// What GLFW last complained about. Its callback has no other way to hand it over.
std::string& last_complaint() {
    static std::string text;
    return text;
}

[[noreturn]] void give_up(const std::string& what) {
    const std::string why = last_complaint().empty() ? "" : " (" + last_complaint() + ")";
    throw GpuUnavailable(what + why + "; the command line works without it (vesselbench --help)");
}

/// GLFW's library, as long as it lives.
class Glfw {
public:
    Glfw() {
        glfwSetErrorCallback([](int, const char* text) { last_complaint() = text; });
        if (!glfwInit()) give_up("there is no display for the window");
    }

    ~Glfw() { glfwTerminate(); }

    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

using Window = std::unique_ptr<GLFWwindow, DestroyWindow>;

/// What the display offers at best: "only OpenGL 3.3 (Core Profile) Mesa on llvmpipe".
std::string best_version() {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    const Window window(glfwCreateWindow(64, 64, "", nullptr, nullptr));
    if (!window) return "no OpenGL at all";
    glfwMakeContextCurrent(window.get());
    const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    const std::string device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    glfwMakeContextCurrent(nullptr);
    return "only OpenGL " + version + " on " + device;
}

GLFWwindow* create(int api) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, wants_debug_output() ? GLFW_TRUE : GLFW_FALSE);
    return glfwCreateWindow(kWidth, kHeight, "vesselbench", nullptr, nullptr);
}

/// A window larger than the screen would hide its buttons where no window manager keeps it inside.
void fit_to_screen(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return;
    int x = 0, y = 0, wide = 0, high = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &wide, &high);
    glfwGetWindowSize(window, &width, &height);
    if (wide <= 0 || high <= 0 || (width <= wide && height <= high)) return;
    glfwSetWindowSize(window, std::min(width, wide), std::min(height, high));
    glfwSetWindowPos(window, x, y);
}

/// EGL first: contexts of other threads can share with it (gpu/context.h).
Window make_window() {
    GLFWwindow* window = create(GLFW_EGL_CONTEXT_API);
    if (window == nullptr) window = create(GLFW_NATIVE_CONTEXT_API);
    if (window == nullptr)
        give_up("the window needs OpenGL 4.3, but the display offers " + best_version());
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window, 800, 560, GLFW_DONT_CARE, GLFW_DONT_CARE);
    fit_to_screen(window);
    return Window(window);
}

double content_scale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return x;
}

/// What the layout prints on a key.
std::string key_name(int position) {
    const char* name = glfwGetKeyName(position, 0);
    return name == nullptr ? "" : name;
}

/// Hands the window's events to ImGui, and counts the frames that show what they cause.
class Events {
public:
    Events(GLFWwindow* window, App& app) : app_(app) {
        glfwSetWindowUserPointer(window, this);
        listen_to_input(window);
        listen_to_window(window);
        ImGui_ImplGlfw_InitForOpenGL(window, false);
    }

    ~Events() { ImGui_ImplGlfw_Shutdown(); }

    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;

    /// Waits until a frame should be drawn.
    void wait() {
        if (frames_ > 0) {
            --frames_;
            return;
        }
        if (app_.is_moving())
            glfwWaitEventsTimeout(kProgressInterval);
        else if (const auto change = app_.next_change())
            glfwWaitEventsTimeout(std::max(*change, kShortestWait));
        else
            glfwWaitEvents();
        note();
    }

private:
    static Events& self(GLFWwindow* window) {
        return *static_cast<Events*>(glfwGetWindowUserPointer(window));
    }

    /// Something has come in.
    static Events& noted(GLFWwindow* window) {
        Events& events = self(window);
        events.note();
        return events;
    }

    static void listen_to_input(GLFWwindow* window) {
        glfwSetCursorPosCallback(window, [](GLFWwindow* from, double, double) { noted(from); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* from, int button, int action, int held) {
            noted(from);
            ImGui_ImplGlfw_MouseButtonCallback(from, button, action, held);
        });
        glfwSetScrollCallback(window, [](GLFWwindow* from, double x, double y) {
            noted(from);
            ImGui_ImplGlfw_ScrollCallback(from, x, y);
        });
        glfwSetKeyCallback(window, [](GLFWwindow* from, int key, int code, int action, int held) {
            const int number = noted(from).number_of(key, action);
            ImGui_ImplGlfw_KeyCallback(from, number, code, action, held);
        });
        glfwSetCharCallback(window, [](GLFWwindow* from, unsigned character) {
            noted(from);
            ImGui_ImplGlfw_CharCallback(from, character);
        });
    }

    static void listen_to_window(GLFWwindow* window) {
        glfwSetDropCallback(window, [](GLFWwindow* from, int count, const char** paths) {
            noted(from).app_.drop({paths, paths + count});
        });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { noted(from); });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* from, int, int) { noted(from); });
        glfwSetCursorEnterCallback(window, [](GLFWwindow* from, int entered) {
            noted(from);
            ImGui_ImplGlfw_CursorEnterCallback(from, entered);
        });
        glfwSetWindowFocusCallback(window, [](GLFWwindow* from, int focused) {
            noted(from);
            ImGui_ImplGlfw_WindowFocusCallback(from, focused);
        });
    }

    void note() { frames_ = kFramesAfterInput; }

    [[nodiscard]] int number_of(int key, int action) {
        return action == GLFW_RELEASE ? keys_.release(key) : keys_.press(key, key_name);
    }

    App& app_;
    PressedKeys keys_;
    int frames_ = kFramesAfterInput;
};

/// Sizes and places in pixels, also where the display system counts in larger units (Wayland).
void count_in_pixels(GLFWwindow* window, float width, float height) {
    int units_wide = 0, units_high = 0;
    glfwGetWindowSize(window, &units_wide, &units_high);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {width, height};
    io.DisplayFramebufferScale = {1, 1};
    if (units_wide <= 0 || units_high <= 0 || !ImGui::IsMousePosValid(&io.MousePos)) return;
    io.MousePos.x *= width / static_cast<float>(units_wide);
    io.MousePos.y *= height / static_cast<float>(units_high);
}

/// What the driver reports while the window runs, if that is wanted.
class DriverReports {
public:
    DriverReports() {
        if (!wants_debug_output()) return;
        output_.emplace([this](const std::string& text) {
            if (first_.empty()) first_ = text;
        });
    }

    /// \throw GpuUnavailable if there was any
    void require_none() const {
        if (!first_.empty()) throw GpuUnavailable("OpenGL reported: " + first_);
    }

private:
    std::string first_;
    std::optional<DebugOutput> output_;
};

AppOptions completed(AppOptions options, GLFWwindow* window) {
    options.device = checked_device();
    options.display_scale = content_scale(window);
    options.wake = [] { glfwPostEmptyEvent(); };
    return options;
}

}  // namespace

struct GlfwShell::Impl {
    explicit Impl(AppOptions options)
        : window(make_window()),
          app(completed(std::move(options), window.get())),
          events(window.get(), app) {}

    void draw() {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window.get(), &width, &height);
        if (width <= 0 || height <= 0) return app.rest();  // it is minimised
        app.set_display_scale(content_scale(window.get()));
        ImGui_ImplGlfw_NewFrame();
        count_in_pixels(window.get(), static_cast<float>(width), static_cast<float>(height));
        drawing.draw(app);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        drawing.render();
        glfwSwapBuffers(window.get());
    }

    /// A window that the user closes stays open while the app asks.
    void ask_before_closing() {
        if (glfwWindowShouldClose(window.get()) == GLFW_TRUE && !app.may_close())
            glfwSetWindowShouldClose(window.get(), GLFW_FALSE);
    }

    void show_title() {
        if (std::string now = app.title(); now != title) {
            title = std::move(now);
            glfwSetWindowTitle(window.get(), title.c_str());
        }
    }

    Glfw glfw;
    Window window;
    DriverReports reports;
    DrawingSession drawing;
    App app;
    Events events;
    std::string title;
};

GlfwShell::GlfwShell(AppOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

GlfwShell::~GlfwShell() = default;

App& GlfwShell::app() {
    return impl_->app;
}

bool GlfwShell::is_open() const {
    return glfwWindowShouldClose(impl_->window.get()) == GLFW_FALSE;
}

void GlfwShell::frame() {
    glfwPollEvents();
    impl_->ask_before_closing();
    impl_->draw();
    impl_->show_title();
    if (impl_->app.closes()) glfwSetWindowShouldClose(impl_->window.get(), GLFW_TRUE);
}

void GlfwShell::require_no_reports() const {
    impl_->reports.require_none();
}

void GlfwShell::wait() {
    impl_->events.wait();
    impl_->ask_before_closing();
}

void run_window(AppOptions options, const std::filesystem::path& file,
                const std::stop_token& stop) {
    GlfwShell shell(std::move(options));
    const std::stop_callback on_stop(stop, [] { glfwPostEmptyEvent(); });
    if (!file.empty()) shell.app().open(file);
    while (shell.is_open() && !stop.stop_requested()) {
        shell.frame();
        shell.wait();
    }
    shell.require_no_reports();
}

}  // namespace vesselbench
