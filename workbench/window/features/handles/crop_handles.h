#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/image/slices.h"
#include "geometry/kernel/measure.h"
#include "workbench/case/scene.h"
#include "workbench/window/features/handles/form_shape.h"

namespace vesselbench {

/// The box that is offered to a form that crops: of all that it would crop. Used by the frame's
/// thread.
class OfferedBox {
public:
    /// Once a frame. \param scene that is cropped; null: none \param form null: none
    void update(const Scene* scene, const OperationForm* form);

    /// The image's box, else that of the surface with a margin [mm]; none: the form does not crop,
    /// or there is nothing to be cropped.
    [[nodiscard]] const std::optional<Bounds>& bounds() const { return bounds_; }

private:
    std::optional<Bounds> bounds_;
    std::shared_ptr<const std::vector<float>> voxels_;  ///< whose bounds these are
    std::shared_ptr<const Positions> positions_;
};

/// The region with its handles. Of a box: the middles of its faces (x, y, z of the low corner, then
/// of the high one), then its corners; of a ball: its centre, then six places on it. Where nothing
/// is given yet, the offered box is shown faintly, or the missing part of a ball.
/// \param offered of OfferedBox [mm]
[[nodiscard]] FormShape crop_shape(const OperationForm& form, const Bounds& offered);

/// The form's texts when a handle is dragged.
/// \param form, offered as for crop_shape at the drag's start
/// \param handle index into crop_shape's handles
/// \param to where the handle is now [mm]
[[nodiscard]] std::vector<FieldText> crop_texts(const OperationForm& form, const Bounds& offered,
                                                std::size_t handle, const Vec3& to);

/// The same region in a slice: a box as a rectangle with handles at the middles of its sides, then
/// at its corners; a ball as a circle. Faint where nothing is given yet, or the slice is beside the
/// box.
/// \param position of the slice on its axis [mm]
[[nodiscard]] FormShape crop_slice_shape(const OperationForm& form, const Bounds& offered,
                                         SlicePlane plane, double position);

/// The form's texts when a handle of crop_slice_shape is dragged: what is across the slice stays.
/// \param form, offered as for crop_slice_shape at the drag's start
[[nodiscard]] std::vector<FieldText> crop_slice_texts(const OperationForm& form,
                                                      const Bounds& offered, SlicePlane plane,
                                                      std::size_t handle, const Vec3& to);

/// The form's texts when a rectangle is drawn in a slice: a box of its width and height; across the
/// slice, the box is as it was before, or the offered one.
/// \param from, to opposite corners [mm]
[[nodiscard]] std::vector<FieldText> crop_rectangle_texts(const OperationForm& form,
                                                          const Bounds& offered, SlicePlane plane,
                                                          const Vec3& from, const Vec3& to);

}  // namespace vesselbench
