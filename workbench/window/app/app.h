#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/render/view_camera.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

struct AppOptions {
    SessionOptions session;           ///< of every case
    std::function<void()> wake;       ///< called by any thread when a frame should be drawn
    std::filesystem::path settings;   ///< folder; empty: the user's
    std::filesystem::path documents;  ///< folder; empty: the user's
    std::filesystem::path cache;      ///< folder; empty: that of the settings, else the user's
    std::string device;               ///< name of the OpenGL device, for the status line
    double display_scale = 1.0;       ///< of the display: 2 where pixels are half as large
    LiveDevice live = {};             ///< device of live smoothing
    std::string notice = {};          ///< a warning that it begins with; empty: none
};

/// The window's content. It draws into the current ImGui and OpenGL contexts, and knows nothing of
/// where these come from. Used by one thread.
class App {
public:
    explicit App(AppOptions options);
    ~App();

    App(const App&) = delete;
    App& operator=(const App&) = delete;

    /// Before ImGui's new frame: fonts and colours for the theme and scale.
    /// \return true if the fonts are new, so that their texture must be made again
    bool restyle();

    void set_display_scale(double scale);

    /// One frame, between ImGui::NewFrame and ImGui::Render.
    void draw();

    /// After draw() has thrown: closes what may have caused it, and reports it once.
    void recover(const std::string& error);

    /// In place of a frame while nothing can be seen: requests that have ended are followed by
    /// those that wait for them.
    void rest();

    /// The user wants to close the window. \return false if an edit runs: then the next frames ask
    /// whether to cancel it
    [[nodiscard]] bool may_close();

    /// True once the user has agreed to that.
    [[nodiscard]] bool closes() const;

    /// True if the next frame would look different without any input: something has ended, or
    /// progress is shown.
    [[nodiscard]] bool is_moving() const;

    /// Time after which the next frame would look different although nothing runs [s]: the two of a
    /// comparison blink. None: never.
    [[nodiscard]] std::optional<double> next_change() const;

    /// A file that was named on the command line, or chosen.
    void open(const std::filesystem::path& path);

    /// Files that were dropped on the window: the first is opened, a message names the others.
    void drop(const std::vector<std::filesystem::path>& files);

    /// True when nothing is being opened, read or measured, and it is drawn.
    [[nodiscard]] bool is_settled() const;

    /// Number of times that the model was drawn.
    [[nodiscard]] int drawings() const;

    /// Of the view, which is the item "view.area".
    [[nodiscard]] const ViewCamera& camera() const;

    [[nodiscard]] Workplace& place();
    [[nodiscard]] const Ui& ui() const;

    /// For the title bar.
    [[nodiscard]] std::string title() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
