#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/vessel/posing/deform_branch.h"
#include "workbench/session/task.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// Where a branch goes that a form deforms.
struct BranchPreview {
    Vec3 at = Vec3::Zero();  ///< the form's place, of which this is [mm]
    BentAxis axis;
    Vec3 from = Vec3::Zero();       ///< the place on the axis at rest [mm]
    double reach = 0.0;             ///< [mm]
    std::vector<RegionLine> rings;  ///< sections of the bent wall
    std::string problem;            ///< why it cannot be bent so; empty: it can
};

/// True if the form moves a place of a branch.
[[nodiscard]] bool deforms_branch(const OperationForm& form);

/// What the form asks for; none if it names no place.
/// \pre deforms_branch
[[nodiscard]] std::optional<BranchDeformation> deformation_in(const OperationForm& form);

/// Bends the branch as the operation would. A problem leaves the axis at rest.
/// \throw Cancelled
[[nodiscard]] BranchPreview preview_of(const Surface& surface, const BranchDeformation& deformation,
                                       const Progress& progress = {});

/// The axis before and after with sections of the bent wall, and two handles: one drags the place,
/// the other one, on the axis, changes the reach.
[[nodiscard]] FormShape deform_shape(const OperationForm& form, const BranchPreview& preview);

/// The form's texts when a handle is dragged.
/// \param preview as for deform_shape at the drag's start
/// \param handle 0 the place, 1 the reach
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> deform_texts(const BranchPreview& preview, std::size_t handle,
                                                  const Vec3& to);

/// Finds previews on a thread of its own; of the questions that come meanwhile the last one is
/// answered. Used by the frame's thread.
class DeformSearch {
public:
    /// \param wake called when a preview is found
    explicit DeformSearch(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame. \param surface null: none \param form null: none that deforms
    void update(const Surface* surface, const OperationForm* form);

    void forget();

    [[nodiscard]] bool pending() const { return task_.pending(); }

    /// The last one of the form's place; none: not known yet.
    [[nodiscard]] const std::optional<BranchPreview>& preview() const { return preview_; }

private:
    Task<BranchPreview> task_;
    std::optional<BranchDeformation> asked_;
    Surface asked_surface_;
    std::optional<BranchPreview> preview_;
};

}  // namespace vesselbench
