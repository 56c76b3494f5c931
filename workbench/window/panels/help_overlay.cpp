#include "workbench/window/panels/help_overlay.h"

#include <array>

#include <imgui.h>

#include "workbench/window/panels/panel_frame.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"

namespace vesselbench {

namespace {

struct KeyHelp {
    const char* keys;
    const char* meaning;
};

constexpr std::array<KeyHelp, 10> kEditing = {{{"Ctrl+Z", "undo"},
                                               {"Ctrl+Shift+Z", "redo"},
                                               {"Space", "switch a blinking comparison"},
                                               {"Ctrl+O", "open a file"},
                                               {"Ctrl+S", "save as"},
                                               {"Ctrl+E", "export the model"},
                                               {"Ctrl+Enter", "apply the operation"},
                                               {"Ctrl+P", "preview the operation"},
                                               {"Esc", "stop picking, cancel, or close"},
                                               {"F1", "this help"}}};
constexpr std::array<KeyHelp, 8> kViewing = {{{"Left drag", "turn"},
                                              {"Middle or Shift+left drag", "move"},
                                              {"Wheel", "zoom to the cursor"},
                                              {"Double click", "set the centre"},
                                              {"1, 3, 7", "from front, side, above"},
                                              {"Ctrl+1, 3, 7", "from the opposite side"},
                                              {"Home", "show everything"},
                                              {"5", "perspective or parallel"}}};

constexpr std::array<KeyHelp, 8> kModes = {
    {{"V", "options of the view"},
     {"C", "clip plane; Ctrl+wheel moves it"},
     {"E", "into the vessel, and out"},
     {"Space, wheel, Up, Down", "in the vessel: fly, forward, back"},
     {"M, D", "measure a distance, a diameter"},
     {"W, L", "source as wireframe, centerlines"},
     {"N, A", "names of openings, places of edits"},
     {"F12", "save a picture of the view"}}};

constexpr std::array<KeyHelp, 5> kBrushing = {{{"Left drag", "brush on the surface"},
                                               {"[ and ], or F", "size, by keys or by the mouse"},
                                               {"With Shift", "the same for the strength"},
                                               {"Shift+left drag", "smooth, whatever the brush"},
                                               {"Ctrl+left drag", "the opposite"}}};

constexpr std::array<KeyHelp, 6> kSlices = {{{"I", "slices of the image"},
                                             {"Shift+I", "its planes in the 3D view"},
                                             {"Left drag", "move the cross"},
                                             {"Right drag", "window and level"},
                                             {"Wheel", "next slice; with Ctrl, zoom"},
                                             {"Home", "show all of a slice"}}};

template <std::size_t N>
void draw_keys(const Ui& ui, const std::string& title, const std::array<KeyHelp, N>& keys,
               float keys_width) {
    group_heading(ui, title);
    space(ui, 1);
    const float left = ImGui::GetCursorPosX();
    for (const KeyHelp& key : keys) {
        text(ui, key.keys, ui.theme.text);
        ImGui::SameLine(left + keys_width);
        text(ui, key.meaning, ui.theme.muted);
    }
}

constexpr const char* kFirstSteps =
    "1. Open an image or a surface, or a bundled case. A project file is made for it.\n"
    "2. Press Prepare to run a whole recipe; or go through the steps on the left, one by one.\n"
    "3. Choose a step, then an operation on the right. Preview shows its result, Apply enters it.\n"
    "4. Click an edit in the rail to change it; click a state of the history to go there.\n"
    "5. Export writes the model. There is nothing to save: each edit is in the project file.";

}  // namespace

void draw_help_overlay(PanelContext& c, const ScreenRect& window) {
    const Ui& ui = c.ui;
    const ScreenRect rect = begin_dialog(ui, "help", window, ui.em * 56, ui.em * 44);
    heading(ui, "Help");
    ImGui::SameLine(rect.width - ui.grid(2.5F) - ImGui::GetFrameHeight());
    if (icon_button(c.ui, "help.close", icons::kClose, "Close  Esc")) c.shown.help = false;
    space(ui, 1);
    ImGui::BeginChild("help text");
    wrapped(ui, kFirstSteps, ui.theme.text, false);
    space(ui, 3);
    const float half = ImGui::GetContentRegionAvail().x / 2;
    ImGui::BeginChild("editing", {half, 0});
    draw_keys(ui, "Editing", kEditing, ui.em * 12);
    space(ui, 2);
    draw_keys(ui, "Brushes", kBrushing, ui.em * 12);
    space(ui, 2);
    draw_keys(ui, "Slices", kSlices, ui.em * 12);
    ImGui::EndChild();
    ImGui::SameLine(0, 0);
    ImGui::BeginChild("viewing");
    draw_keys(ui, "View", kViewing, ui.em * 12);
    space(ui, 2);
    draw_keys(ui, "Ways of viewing", kModes, ui.em * 12);
    ImGui::EndChild();
    ImGui::EndChild();
    end_frame();
}

}  // namespace vesselbench
