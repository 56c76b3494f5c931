#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "gpu/render/renderer.h"
#include "workbench/window/case/document.h"

namespace vesselbench {

/// Small pictures of the states of the open case and of recent projects. They are made one after
/// the other while nothing else runs: scenes are read by the session's thread, laid out by another
/// one, and drawn in a few milliseconds. The current state's picture is kept in the cache folder as
/// the project's. Needs the window's OpenGL context.
class Thumbnails {
public:
    /// \param wake called by other threads when update() has something to do
    Thumbnails(std::function<void()> wake, std::filesystem::path cache);
    ~Thumbnails();

    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;

    /// Once a frame. Draws at most one picture.
    void update(const Document& document, Renderer& renderer);

    /// The texture of a state as far as its edits have run; 0: it is not made yet, or there is no
    /// surface. Pictures are made of states that are asked for.
    [[nodiscard]] unsigned of_state(StateId state);

    /// The texture of a project as it was left; 0: none is known.
    [[nodiscard]] unsigned of_project(const std::filesystem::path& project);

    /// True while pictures are being made or kept.
    [[nodiscard]] bool pending() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
