#include "workbench/window/shell/glfw_shell.h"

#include <cstdlib>
#include <memory>

// GLFW must not include OpenGL's headers itself.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include "geometry/kernel/errors.h"
#include "workbench/window/shell/drawing_session.h"

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

GLFWwindow* create(int api) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    return glfwCreateWindow(kWidth, kHeight, "vesselbench", nullptr, nullptr);
}

/// EGL first: contexts of other threads can share with it (gpu/context.h).
Window make_window() {
    GLFWwindow* window = create(GLFW_EGL_CONTEXT_API);
    if (window == nullptr) window = create(GLFW_NATIVE_CONTEXT_API);
    if (window == nullptr) give_up("the display offers no OpenGL 4.3 core context");
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window, 800, 560, GLFW_DONT_CARE, GLFW_DONT_CARE);
    return Window(window);
}

double content_scale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return x;
}

/// The backend of ImGui, and our own reactions to the window's events.
class Events {
public:
    Events(GLFWwindow* window, App& app) : app_(app) {
        glfwSetWindowUserPointer(window, this);
        glfwSetDropCallback(window, [](GLFWwindow* from, int count, const char** paths) {
            if (count > 0) self(from).app_.open(paths[0]);
        });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { self(from).note(); });
        glfwSetFramebufferSizeCallback(window,
                                       [](GLFWwindow* from, int, int) { self(from).note(); });
        ImGui_ImplGlfw_InitForOpenGL(window, true);
    }

    ~Events() { ImGui_ImplGlfw_Shutdown(); }

    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;

    void note() { frames_ = kFramesAfterInput; }

    /// Waits until a frame should be drawn.
    void wait() {
        if (frames_ > 0) {
            --frames_;
            return glfwPollEvents();
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

    App& app_;
    int frames_ = kFramesAfterInput;
};

void draw_frame(GLFWwindow* window, DrawingSession& drawing, App& app) {
    app.set_display_scale(content_scale(window));
    ImGui_ImplGlfw_NewFrame();
    drawing.draw(app);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    drawing.render();
    glfwSwapBuffers(window);
}

void run(GLFWwindow* window, DrawingSession& drawing, App& app) {
    Events events(window, app);
    std::string title;
    while (!glfwWindowShouldClose(window)) {
        draw_frame(window, drawing, app);
        if (app.title() != title) {
            title = app.title();
            glfwSetWindowTitle(window, title.c_str());
        }
        events.wait();
    }
}

}  // namespace

void run_window(AppOptions options, const std::filesystem::path& file) {
    const Glfw glfw;
    const Window window = make_window();
    options.device = checked_device();
    options.display_scale = content_scale(window.get());
    options.wake = [] { glfwPostEmptyEvent(); };
    DrawingSession drawing;
    App app(std::move(options));
    if (!file.empty()) app.open(file);
    run(window.get(), drawing, app);
}

}  // namespace vesselbench
