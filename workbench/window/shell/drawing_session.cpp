#include "workbench/window/shell/drawing_session.h"

#include <exception>
#include <string>

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

std::string checked_device() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string device = name == nullptr ? "an unnamed device" : name;
    if (epoxy_gl_version() < 43)
        throw GpuUnavailable("the window needs OpenGL 4.3, but " + device + " offers " +
                             std::to_string(epoxy_gl_version() / 10) + "." +
                             std::to_string(epoxy_gl_version() % 10) +
                             "; the command line works without it (vesselbench --help)");
    return device;
}

DrawingSession::DrawingSession() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;  // an idle window draws nothing
    ImGui_ImplOpenGL3_Init("#version 430 core");
}

DrawingSession::~DrawingSession() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void DrawingSession::draw(App& app) {
    if (app.restyle()) ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_NewFrame();
    if (ImGui::GetIO().Fonts->TexID == nullptr) ImGui_ImplOpenGL3_CreateFontsTexture();
    ImGui::NewFrame();
    try {
        app.draw();
    } catch (const std::exception& error) {
        ImGui::ErrorCheckEndFrameRecover(nullptr);
        app.recover(error.what());
    }
    ImGui::Render();
}

void DrawingSession::render() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    glViewport(0, 0, static_cast<int>(size.x), static_cast<int>(size.y));
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace vesselbench
