#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "gpu/render/drawn_surface.h"
#include "gpu/render/layers.h"
#include "workbench/session/task.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// The part of a surface that would be cut off, lit up. It is found on a thread of its own.
class BranchHighlight {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit BranchHighlight(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame. Needs the window's OpenGL context.
    /// \param form null: none; only forms that remove a branch light one up
    /// \param surface that is drawn; null: none
    /// \param hovered the tip under the cursor, instead of the form's [mm]
    void update(const OperationForm* form, const Surface* surface,
                const std::optional<Vec3>& hovered);

    /// Counts changes.
    [[nodiscard]] int version() const { return version_; }

    [[nodiscard]] bool pending() const { return task_.pending(); }

    void add_to(Layers& layers, double pull) const;

private:
    struct Question {
        Vec3 tip;
        double margin;

        bool operator==(const Question&) const = default;
    };

    void clear();

    std::optional<Question> asked_;
    std::shared_ptr<const Positions> positions_;  ///< of the surface
    std::shared_ptr<const DrawnSurface> drawn_;
    Task<std::optional<DrawingArrays>> task_;
    int version_ = 0;
};

}  // namespace vesselbench
