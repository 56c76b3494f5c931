#include "workbench/window/panels/file_dialog.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "geometry/kernel/wording.h"
#include "workbench/export/export_formats.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/style/icons.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/panel_frame.h"
#include "workbench/window/widgets/row.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

bool is_recipe(FileQuestion question) {
    return question == FileQuestion::SaveRecipe || question == FileQuestion::SaveEdits;
}

std::vector<std::string> suffixes_for(FileQuestion question) {
    if (question == FileQuestion::SaveCopy) return {".vbench"};
    if (question == FileQuestion::Picture) return {".png"};
    if (question == FileQuestion::Measures) return {".csv"};
    if (question == FileQuestion::ReviewPage) return {".html"};
    if (is_recipe(question) || question == FileQuestion::Verdicts) return {".json"};
    if (question == FileQuestion::Open) return openable_suffixes();
    if (question == FileQuestion::Parameter) {
        std::vector<std::string> suffixes = openable_suffixes();
        std::erase(suffixes, ".vbench");
        return suffixes;
    }
    std::vector<std::string> written;
    for (const ExportFormat& format : export_formats())
        written.insert(written.end(), format.suffixes.begin(), format.suffixes.end());
    return written;
}

const char* title_of(FileQuestion question) {
    switch (question) {
        case FileQuestion::Open:
            return "Open";
        case FileQuestion::SaveCopy:
            return "Save as";
        case FileQuestion::Export:
            return "Export the model";
        case FileQuestion::Parameter:
            return "Choose a file";
        case FileQuestion::Picture:
            return "Save a picture of the view";
        case FileQuestion::Measures:
            return "Export the measurements";
        case FileQuestion::SaveRecipe:
            return "Save the recipe";
        case FileQuestion::SaveEdits:
            return "Save the edits as a recipe";
        case FileQuestion::ReviewPage:
            return "Write a page for reviewers";
        case FileQuestion::Verdicts:
            return "Import verdicts";
        case FileQuestion::None:
            break;
    }
    return "";
}

bool has_volume(const Document& document) {
    const Scene* scene = document.newest();
    return scene != nullptr && scene->volume_mesh;
}

/// Whether the variant has a volume mesh, or pending edits that may make one.
bool can_have_volume(const Document& document) {
    return pending_count(*document.snapshot(), document.variant()) > 0 || has_volume(document);
}

/// What the name of a new file adds to the project's. A volume mesh is what one was made for.
const char* ending_for(FileQuestion question, bool volume) {
    if (question == FileQuestion::Picture) return ".png";
    if (question == FileQuestion::Measures) return ".csv";
    if (is_recipe(question)) return " recipe.json";
    if (question == FileQuestion::ReviewPage) return " review.html";
    if (question != FileQuestion::Export) return " copy.vbench";
    return volume ? ".vtu" : ".stl";
}

/// The formats in the order of the list: those of the volume mesh first, if there is one.
std::vector<ExportFormat> listed_formats(bool volume) {
    std::vector<ExportFormat> formats = export_formats();
    if (volume)
        std::stable_partition(formats.begin(), formats.end(), [](const ExportFormat& format) {
            return format.kind == FormatKind::VolumeMesh;
        });
    return formats;
}

/// The suffix that a name must have; empty: any.
std::string needed_suffix(FileQuestion question) {
    if (question == FileQuestion::SaveCopy) return ".vbench";
    if (question == FileQuestion::Measures) return ".csv";
    if (is_recipe(question)) return ".json";
    if (question == FileQuestion::ReviewPage) return ".html";
    return question == FileQuestion::Picture ? ".png" : "";
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

/// Whether there is something, or why that cannot be found out: a name may be too long, a folder
/// closed to the user.
struct Presence {
    bool exists = false;
    std::string problem;
};

Presence presence_of(const fs::path& file) {
    std::error_code error;
    const fs::file_type type = fs::status(file, error).type();
    if (type == fs::file_type::none) return {.problem = error.message()};
    return {.exists = type != fs::file_type::not_found};
}

std::string size_text(std::uintmax_t bytes) {
    if (bytes < 1024) return std::to_string(bytes) + " B";
    if (bytes < 1024 * 1024) return std::to_string(bytes / 1024) + " KB";
    return std::to_string(bytes / (1024 * 1024)) + " MB";
}

}  // namespace

bool FileDialog::writes() const {
    return question_ == FileQuestion::SaveCopy || question_ == FileQuestion::Export ||
           question_ == FileQuestion::Picture || question_ == FileQuestion::Measures ||
           is_recipe(question_) || question_ == FileQuestion::ReviewPage;
}

void FileDialog::enter(const fs::path& folder) {
    listing_ = {.folder = folder};
    typed_folder_ = folder.string();
    others_.clear();
    error_.clear();
    reading_.start([folder, suffixes = suffixes_for(question_)](const Progress& progress) {
        return list_folder(folder, suffixes, progress);
    });
}

void FileDialog::take_listing() {
    if (!reading_.poll()) return;
    auto listing = reading_.take();
    if (!listing) error_ = reading_.problem();
    if (!listing || listing->folder != listing_.folder) return;
    listing_ = std::move(*listing);
    if (!listing_.error.empty()) error_ = listing_.error;
}

const char* FileDialog::empty_text() const {
    if (reading_.pending()) return "Reading the folder ...";
    return writes() ? "No files of this type here." : "Nothing to open here.";
}

void FileDialog::begin(PanelContext& c) {
    question_ = c.place.question();
    const fs::path project = c.place.document.project();
    const fs::path near = project.parent_path();
    enter(!near.empty() ? near : !listing_.folder.empty() ? listing_.folder : documents_folder());
    name_.clear();
    replaced_.clear();
    doubted_.clear();
    clicked_.clear();
    if (question_ == FileQuestion::Export) export_.begin(c);
    if (writes())
        name_ = free_file(listing_.folder / (project.stem().string() +
                                             ending_for(question_, has_volume(c.place.document))))
                    .filename()
                    .string();
}

void FileDialog::draw_folder_line(PanelContext& c) {
    if (icon_button(c.ui, "file.up", icons::kUp, "Parent folder"))
        enter(listing_.folder.parent_path());
    ImGui::SameLine();
    if (icon_button(c.ui, "file.home", icons::kHome, "Home folder")) enter(home_folder());
    ImGui::SameLine();
    if (text_field(c.ui, "file.folder", typed_folder_) && is_folder(typed_folder_))
        enter(typed_folder_);
    folder_entered_ = ImGui::IsItemDeactivated() && c.shown.keys.has(KeyCommand::Accept);
    if (folder_entered_) accept_folder(c);
    draw_dicom_line(c);
}

/// The slices of a series are opened together, as their folder.
void FileDialog::draw_dicom_line(PanelContext& c) {
    if (!listing_.has_dicom || writes()) return;
    if (!button(c.ui, "file.dicom", "Open the DICOM slices of this folder",
                {.icon = icons::kImage, .width = ImGui::GetContentRegionAvail().x}))
        return;
    question_ = FileQuestion::None;
    c.place.answer(listing_.folder);
}

/// Enter in the field of the folder: a file that was typed there is the answer.
void FileDialog::accept_folder(PanelContext& c) {
    const fs::path typed = typed_folder_;
    if (is_folder(typed)) return;
    if (!is_file(typed)) {
        error_ = "'" + typed.filename().string() + "' is no folder that can be read";
        return;
    }
    enter(typed.parent_path());
    name_ = typed.filename().string();
    finish(c);
}

void FileDialog::choose(PanelContext& c, const FolderEntry& entry, bool twice) {
    const bool answers =
        !entry.folder || (entry.openable_folder && question_ == FileQuestion::Open);
    if (entry.folder && (!entry.openable_folder || (twice && !answers)))
        return enter(listing_.folder / entry.name);
    if (name_ != entry.name) error_.clear();
    if (takes_several(question_) && !entry.folder && ImGui::GetIO().KeyCtrl)
        return add_or_remove(entry.name);
    others_.clear();
    name_ = entry.name;
    if (twice && answers) finish(c);
}

/// The name of the field is the one that was added last.
void FileDialog::add_or_remove(const std::string& name) {
    if (std::erase(others_, name) > 0) return;
    const bool removes = name_ == name;
    if (!removes && !name_.empty()) others_.push_back(name_);
    name_ = name;
    if (!removes) return;
    name_ = others_.empty() ? "" : others_.back();
    if (!others_.empty()) others_.pop_back();
}

bool FileDialog::is_chosen(const std::string& name) const {
    return name == name_ || std::ranges::count(others_, name) > 0;
}

/// Acts on a click on the last row.
void FileDialog::handle_click(PanelContext& c, const FolderEntry& entry, bool clicked) {
    const fs::path file = listing_.folder / entry.name;
    const bool same = clicked_ == file;
    const bool twice = row_double_clicked() && same;
    // The second click on a folder hits what the folder holds.
    const bool strays = ImGui::GetIO().MouseClickedLastCount[ImGuiMouseButton_Left] > 1 && !same;
    if (!twice && (!clicked || strays)) return;
    clicked_ = file;
    choose(c, entry, twice);
}

void FileDialog::draw_entries(PanelContext& c, float height) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, c.ui.theme.field);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::BeginChild("entries", {0, height});
    const fs::path folder = listing_.folder;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(listing_.entries.size()), row_height(c.ui, false));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            if (question_ == FileQuestion::None || listing_.folder != folder)
                break;  // it was answered
            draw_entry(c, FolderEntry(listing_.entries[static_cast<std::size_t>(i)]));
        }
    if (listing_.entries.empty()) {
        ImGui::SetCursorPos({c.ui.grid(1.5F), c.ui.grid(1)});
        text(c.ui, empty_text(), c.ui.theme.muted);
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void FileDialog::draw_entry(PanelContext& c, const FolderEntry& entry) {
    const bool clicked = row(c.ui, "file.entry." + entry.name,
                             {.icon = entry.openable_folder ? icons::kCube
                                      : entry.folder        ? icons::kFolder
                                                            : icons::kFile,
                              .icon_colour = entry.folder ? c.ui.theme.accent : 0,
                              .title = entry.name,
                              .right = entry.folder ? "" : size_text(entry.bytes),
                              .selected = is_chosen(entry.name)});
    handle_click(c, entry, clicked);
}

/// The formats, and the flow of a solver's case below them.
void FileDialog::draw_formats(PanelContext& c) {
    const bool flow = takes_flow();
    ImGui::BeginChild("formats", {0, flow ? ImGui::GetContentRegionAvail().y * 0.35F : 0});
    draw_format_list(c);
    ImGui::EndChild();
    if (!flow) return;
    ImGui::BeginChild("flow");
    export_.draw_flow(c);
    ImGui::EndChild();
}

/// Another suffix for the name.
void FileDialog::draw_format_list(PanelContext& c) {
    group_heading(c.ui, "Format");
    space(c.ui, 0.5F);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, c.ui.grid(0.25F)});
    const std::string suffix = fs::path(name_).extension().string();
    const bool can_have = can_have_volume(c.place.document);
    for (const ExportFormat& format : listed_formats(has_volume(c.place.document))) {
        const std::string own = format.suffixes.empty() ? "" : format.suffixes[0];
        const bool writable = can_have || format.kind != FormatKind::VolumeMesh;
        if (row(c.ui, "format." + (own.empty() ? format.name : own),
                {.title = format.name + (own.empty() ? "" : "  " + own),
                 .detail = writable ? format.content + ", in " + format.unit
                                    : "Needs a volume mesh: run Tetrahedralize",
                 .selected = suffix == own,
                 .enabled = writable,
                 .help = format.content + ", in " + format.unit}))
            name_ = fs::path(name_).stem().string() + own;
    }
    ImGui::PopStyleVar();
}

bool FileDialog::can_finish() const {
    return !name_.empty();
}

/// For error texts.
std::string FileDialog::short_name() const {
    constexpr std::size_t kMost = 40;  // characters
    return name_.size() <= kMost ? name_ : name_.substr(0, kMost) + "...";
}

/// An exported file may be replaced, by asking for it twice; a project never.
bool FileDialog::may_write(const fs::path& file) {
    const Presence presence = presence_of(file);
    if (!presence.problem.empty()) {
        error_ = "'" + short_name() + "' cannot be written: " + presence.problem;
        return false;
    }
    if (!presence.exists) return true;
    const bool replaceable = question_ == FileQuestion::Export && is_file(file);
    if (replaceable && replaced_ == file) return true;
    error_ = "'" + short_name() + "' exists: " +
             (replaceable ? "press Export again to replace it" : "choose another name");
    replaced_ = file;
    return false;
}

/// A model that reviewers have not accepted may be exported, by asking for it twice.
bool FileDialog::may_export(const fs::path& file) {
    const std::string refusal = export_.refusal(), doubt = export_.doubt();
    if (!refusal.empty()) {
        error_ = refusal;
        return false;
    }
    if (doubt.empty() || doubted_ == file) return true;
    error_ = doubt + "; press Export again to export it as it is";
    doubted_ = file;
    return false;
}

/// The chosen format is a solver's case.
bool FileDialog::takes_flow() const {
    const ExportFormat* format = row_that_writes(export_formats(), name_);
    return format != nullptr && !format->folder.empty();
}

void FileDialog::export_to(PanelContext& c, const fs::path& file) {
    const auto flow = takes_flow() ? export_.flow() : std::nullopt;
    c.place.ask(FileQuestion::None);
    c.place.document.export_to(file, flow);
}

void FileDialog::finish(PanelContext& c) {
    if (!can_finish()) return;
    if (!lower_case(name_).ends_with(needed_suffix(question_))) name_ += needed_suffix(question_);
    const fs::path file = listing_.folder / name_;
    const Presence presence = writes() ? Presence{.exists = true} : presence_of(file);
    if (!presence.exists) {
        error_ =
            "'" + short_name() + "' " +
            (presence.problem.empty() ? "does not exist" : "cannot be read: " + presence.problem);
        return;
    }
    if (writes() && !may_write(file)) return;
    if (question_ == FileQuestion::Export && !may_export(file)) return;
    std::vector<fs::path> files = {file};
    for (const std::string& name : others_) files.push_back(listing_.folder / name);
    std::ranges::sort(files);
    if (std::exchange(question_, FileQuestion::None) == FileQuestion::Export)
        return export_to(c, file);
    c.place.answer(files);
}

std::string FileDialog::accept_label() const {
    if (question_ == FileQuestion::Export) return "Export";
    if (writes()) return "Save";
    return others_.empty() ? "Open" : "Open " + counted(others_.size() + 1, "file");
}

void FileDialog::draw_name_line(PanelContext& c) {
    const float width = c.ui.em * 8;
    const float field = ImGui::GetContentRegionAvail().x - 2 * (width + c.ui.grid(1));
    if (text_field(c.ui, "file.name", name_, {.hint = "File name", .width = field})) {
        error_.clear();
        others_.clear();
    }
    const bool enters =
        c.shown.keys.has(KeyCommand::Accept) && !ImGui::IsAnyItemActive() && !folder_entered_;
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "file.cancel", "Cancel", {.width = width})) {
        question_ = FileQuestion::None;
        return c.place.ask(FileQuestion::None);
    }
    ImGui::SameLine(0, c.ui.grid(1));
    if (button(c.ui, "file.accept", accept_label(),
               {.primary = true, .enabled = can_finish(), .width = width}) ||
        enters)
        finish(c);
}

void FileDialog::draw(PanelContext& c, const ScreenRect& window) {
    if (c.place.question() == FileQuestion::None) {
        question_ = FileQuestion::None;
        return;
    }
    if (question_ != c.place.question()) begin(c);
    take_listing();
    export_.poll();
    const Ui& ui = c.ui;
    begin_dialog(ui, "file dialog", window, ui.em * 56, ui.em * 36);
    heading(ui, title_of(question_));
    if (question_ == FileQuestion::SaveCopy)
        wrapped(ui,
                "Writes the project with its whole history. You go on working in " +
                    c.place.document.project().filename().string() + ".",
                ui.theme.muted);
    if (takes_several(question_))
        wrapped(ui, "Ctrl+click chooses several files; each is entered by itself.", ui.theme.muted);
    if (question_ == FileQuestion::Export) export_.draw_review(c);
    space(ui, 1);
    draw_folder_line(c);
    const float line = ImGui::GetFrameHeight();
    const float error = ImGui::GetTextLineHeight() + ui.grid(1);
    const float height = ImGui::GetContentRegionAvail().y - line - error - ui.grid(2);
    const bool exports = question_ == FileQuestion::Export;
    ImGui::BeginChild("list", {exports ? ImGui::GetContentRegionAvail().x * 0.6F : 0, height});
    draw_entries(c, 0);
    ImGui::EndChild();
    if (exports) {
        ImGui::SameLine(0, ui.grid(2));
        ImGui::BeginChild("format list", {0, height});
        draw_formats(c);
        ImGui::EndChild();
    }
    text(ui, error_.empty() ? " " : error_, ui.theme.danger);
    draw_name_line(c);
    end_frame();
}

}  // namespace vesselbench
