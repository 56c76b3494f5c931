#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "workbench/session/task.h"
#include "workbench/window/core/panel_sizes.h"
#include "workbench/window/drawing/view_choice.h"

namespace vesselbench {

/// A project that was open before.
struct RecentProject {
    std::filesystem::path file;
    std::string opened;    ///< local time, "2024-05-17 09:30"
    bool missing = false;  ///< the file is not there now
};

/// What the window remembers between two starts: appearance and recent projects, newest first.
class Settings {
public:
    static constexpr std::size_t kMostRecent = 12;

    /// Reads settings.json of this folder; a missing or damaged file gives the defaults.
    explicit Settings(std::filesystem::path folder);
    ~Settings();
    Settings(Settings&&) = default;

    /// The sizes of the text that are offered.
    static constexpr std::array kScales = {0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5};

    bool dark = true;
    double scale = 1.0;  ///< of all sizes, on top of the display's; in the range of kScales
    ShownLayers layers;  ///< of the view
    PanelSizes panels;
    std::string reviewer, reviewer_role;  ///< who gives verdicts, as entered; empty: not known

    [[nodiscard]] const std::vector<RecentProject>& recent() const { return recent_; }

    /// Puts a project first in the list.
    void remember(const std::filesystem::path& project);
    void forget(const std::filesystem::path& project);

    /// The scale so many steps of kScales larger, as far as there are any.
    void change_scale(int steps);

    /// Looks which projects are missing.
    void refresh();

    /// \return false if the file cannot be written, which is no error for the user's work
    bool save() const;

    /// Saves on another thread: a disk may be slow. The last one counts; the destructor waits for
    /// it.
    void save_soon();

private:
    void read();
    [[nodiscard]] std::string text() const;

    std::filesystem::path folder_;
    std::vector<RecentProject> recent_;
    Task<Nothing> saving_;
};

}  // namespace vesselbench
