#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "workbench/session/task.h"
#include "workbench/window/core/panel_context.h"
#include "workbench/window/panels/export_choices.h"
#include "workbench/window/panels/folder_listing.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

/// The window's own dialog for a file to open or to write, shown while the workplace asks for one.
/// Folders are read by a thread of its own: one on a network may take its time.
class FileDialog {
public:
    /// \param wake called by that thread when there is something new to draw
    explicit FileDialog(std::function<void()> wake) : reading_(std::move(wake)) {}

    void draw(PanelContext& context, const ScreenRect& window);

    /// True while a folder is being read.
    [[nodiscard]] bool pending() const { return reading_.pending() || export_.pending(); }

private:
    void begin(PanelContext& context);
    void enter(const std::filesystem::path& folder);
    void take_listing();
    [[nodiscard]] const char* empty_text() const;
    void draw_folder_line(PanelContext& context);
    void draw_dicom_line(PanelContext& context);
    void accept_folder(PanelContext& context);
    void draw_entries(PanelContext& context, float height);
    void draw_entry(PanelContext& context, const FolderEntry& entry);
    void handle_click(PanelContext& context, const FolderEntry& entry, bool clicked);
    void draw_formats(PanelContext& context);
    void draw_format_list(PanelContext& context);
    void draw_name_line(PanelContext& context);
    void choose(PanelContext& context, const FolderEntry& entry, bool twice);
    void add_or_remove(const std::string& name);
    [[nodiscard]] bool is_chosen(const std::string& name) const;
    [[nodiscard]] std::string accept_label() const;
    void finish(PanelContext& context);
    [[nodiscard]] bool writes() const;
    [[nodiscard]] bool can_finish() const;
    [[nodiscard]] std::string short_name() const;
    [[nodiscard]] bool may_write(const std::filesystem::path& file);
    [[nodiscard]] bool may_export(const std::filesystem::path& file);
    [[nodiscard]] bool takes_flow() const;
    void export_to(PanelContext& context, const std::filesystem::path& file);

    FileQuestion question_ = FileQuestion::None;
    FolderListing listing_;  ///< without entries while they are read
    Task<FolderListing> reading_;
    std::string typed_folder_;
    bool folder_entered_ = false;  ///< by Enter, in this frame
    std::string name_;
    std::vector<std::string> others_;  ///< names that are chosen besides name_
    std::string error_;
    std::filesystem::path clicked_;   ///< the last entry that was clicked
    std::filesystem::path replaced_;  ///< a file that the user was warned about
    std::filesystem::path doubted_;   ///< an export whose review the user was warned about
    ExportChoices export_;
};

}  // namespace vesselbench
