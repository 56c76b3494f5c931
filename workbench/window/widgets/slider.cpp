#include "workbench/window/widgets/slider.h"

#include <imgui.h>

#include "workbench/window/widgets/controls.h"

namespace vesselbench {

bool slider(Ui& ui, const std::string& name, double& value, const SliderLook& look) {
    std::string format;  // the text, not a conversion
    for (const char letter : look.text) format += letter == '%' ? "%%" : std::string(1, letter);
    ImGui::SetNextItemWidth(look.width);
    ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, ui.em * 0.7F);
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, faded(ui.theme.accent, 0.75));
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, ui.theme.accent);
    const bool changed = ImGui::SliderScalar(
        ("##" + name).c_str(), ImGuiDataType_Double, &value, &look.least, &look.most,
        format.c_str(), ImGuiSliderFlags_NoInput | ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopStyleColor(2);
    ImGui::PopStyleVar();
    ui.item(name);
    if (!look.help.empty()) help_on_hover(ui, look.help);
    return changed;
}

}  // namespace vesselbench
