#include "workbench/window/panels/start_screen.h"

#include <algorithm>
#include <cstdint>

#include <imgui.h>

#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/bundled_cases.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/features/history/thumbnail_drawing.h"
#include "workbench/window/features/history/thumbnails.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> bundled_cases() {
    const fs::path folder = bundled_cases_folder();
    std::vector<fs::path> cases;
    std::error_code error;
    if (folder.empty()) return cases;
    fs::directory_iterator entries(folder, error);
    for (const fs::directory_iterator end; !error && entries != end; entries.increment(error)) {
        std::error_code ignored;
        if (fs::exists(entries->path() / "case.json", ignored)) cases.push_back(entries->path());
    }
    std::ranges::sort(cases);
    return cases;
}

const char* about_phantom(const std::string& name) {
    if (name == "aneurysm") return "Side-wall aneurysm with stubs, bumps and a narrowing";
    if (name == "tube") return "A straight vessel with two ends";
    if (name == "torus") return "A closed ring";
    if (name == "y") return "A bifurcation";
    if (name == "vessel") return "A slender vessel in thick slices";
    if (name == "tumour") return "A compact shape beside a vessel";
    if (name == "sphere-missing-slices") return "A sphere with staircases";
    if (name == "cylinder-with-cuboid") return "A cylinder near another structure";
    if (name == "plane-with-sphere") return "A plane near a sphere";
    return "A phantom";
}

/// The picture of the last row's project, at the row's left end; else an icon.
void draw_picture(PanelContext& c, const RecentProject& entry, float width) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    const float height = width * kThumbnailHeight / kThumbnailWidth;
    const float top = (from.y + to.y - height) / 2, left = from.x + c.ui.grid(0.5F);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const unsigned texture = entry.missing ? 0 : c.thumbnails.of_project(entry.file);
    if (texture != 0)
        return draw.AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t{texture}), {left, top},
                             {left + width, top + height});
    const ImVec2 size = ImGui::CalcTextSize(icons::kVessel);
    draw.AddText({left + (width - size.x) / 2, (from.y + to.y - size.y) / 2},
                 entry.missing ? c.ui.theme.muted : c.ui.theme.accent, icons::kVessel);
}

void draw_recent(PanelContext& c) {
    group_heading(c.ui, "Recent projects");
    space(c.ui, 1);
    const float picture = c.ui.em * 3.7F;
    const std::vector<RecentProject> recent = c.place.settings.recent();
    if (recent.empty())
        wrapped(c.ui, "Projects that you open are listed here.", c.ui.theme.muted, false);
    for (std::size_t i = 0; i < recent.size(); ++i) {
        const RecentProject& entry = recent[i];
        const std::string folder = entry.file.parent_path().string();
        if (row(c.ui, "recent." + std::to_string(i),
                {.title = entry.file.stem().string(),
                 .detail = entry.missing ? "missing: " + folder : folder,
                 .right = entry.opened,
                 .strong = true,
                 .enabled = !entry.missing,
                 .indent = picture}))
            c.place.open(entry.file);
        draw_picture(c, entry, picture);
    }
}

void draw_examples(PanelContext& c) {
    group_heading(c.ui, "Bundled cases");
    space(c.ui, 1);
    static const std::vector<fs::path> cases = bundled_cases();
    for (const fs::path& folder : cases)
        if (row(c.ui, "case." + folder.filename().string(),
                {.icon = icons::kCube,
                 .icon_colour = c.ui.theme.accent,
                 .title = readable(folder.filename().string()),
                 .detail = "Image and mask with a recipe: a good first case",
                 .strong = true}))
            c.place.open_bundled(folder);
    space(c.ui, 2);
    group_heading(c.ui, "Phantoms");
    space(c.ui, 1);
    for (const std::string& name : phantom_names())
        if (std::ranges::none_of(cases, [&](const fs::path& f) { return f.filename() == name; }) &&
            row(c.ui, "phantom." + name,
                {.icon = icons::kGrid, .title = readable(name), .detail = about_phantom(name)}))
            c.place.open_phantom(name);
}

void draw_welcome(PanelContext& c) {
    const Ui& ui = c.ui;
    ImGui::PushFont(ui.fonts.title);
    text(ui, "vesselbench", ui.theme.text);
    ImGui::PopFont();
    wrapped(ui, "From vessel images and raw surfaces to models for flow simulation and printing.",
            ui.theme.muted, false);
    space(ui, 3);
    const float width = ImGui::GetContentRegionAvail().x;
    if (button(c.ui, "start.open", "Open a file",
               {.icon = icons::kOpen, .primary = true, .width = width}))
        c.place.ask(FileQuestion::Open);
    space(ui, 1);
    wrapped(ui,
            "Or drop a file on this window: a project (.vbench), a surface such as STL, PLY or "
            "VTP, an image such as NRRD or NIfTI, or a folder of DICOM slices.",
            ui.theme.muted);
    space(ui, 3);
    wrapped(ui, "Every edit is stored as it is made and can be undone. F1 shows the keys.",
            ui.theme.muted);
}

/// What is being opened, where the user looks.
void draw_opening(PanelContext& c) {
    const auto activity = c.place.document.activity();
    if (!activity) return;
    space(c.ui, 2);
    text(c.ui, std::string(icons::kPending) + "  Opening the case", c.ui.theme.accent);
    wrapped(c.ui, readable_sentence(activity->what), c.ui.theme.muted);
    c.ui.item("start.opening");
}

void draw_failure(PanelContext& c) {
    const auto& failure = c.place.document.failure();
    if (!failure) return;
    space(c.ui, 2);
    text(c.ui, std::string(icons::kError) + "  This could not be opened", c.ui.theme.danger);
    wrapped(c.ui, failure->text, c.ui.theme.danger);
    if (button(c.ui, "start.dismiss", "Dismiss", {.quiet = true}))
        c.place.document.forget_failure();
}

void draw_column(PanelContext& c, const std::string& id, float width, void (*draw)(PanelContext&)) {
    ImGui::BeginChild(id.c_str(), {width, 0});
    draw(c);
    ImGui::EndChild();
}

}  // namespace

void draw_start_screen(PanelContext& c, const ScreenRect& rect) {
    const Ui& ui = c.ui;
    begin_frame(c.ui, "start", rect, {.padding = 0, .scrolls = false});
    const float width = std::min(rect.width - ui.grid(8), ui.em * 78);
    const float top = std::max(ui.grid(4), std::min(ui.grid(12), rect.height * 0.08F));
    const float gap = ui.grid(5), column = (width - 2 * gap) / 3;
    ImGui::SetCursorPos({(rect.width - width) / 2, top});
    ImGui::BeginChild("start columns", {width, rect.height - top - ui.grid(2)});
    draw_column(c, "welcome", column, [](PanelContext& context) {
        draw_welcome(context);
        draw_opening(context);
        draw_failure(context);
    });
    ImGui::SameLine(0, gap);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.grid(1), ui.grid(0.25F)});
    draw_column(c, "recent", column, draw_recent);
    ImGui::SameLine(0, gap);
    draw_column(c, "examples", column, draw_examples);
    ImGui::PopStyleVar();
    ImGui::EndChild();
    end_frame();
}

}  // namespace vesselbench
