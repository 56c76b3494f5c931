#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/image/slices.h"
#include "workbench/case/scene.h"
#include "workbench/session/task.h"

namespace vesselbench {

/// All that is drawn of one plane.
struct SliceContent {
    SlicePlane plane = SlicePlane::Axial;
    double position = 0.0;  ///< on the plane's axis [mm]
    ImageSlice image;
    std::optional<ImageSlice> mask;
    std::vector<SliceLine> outline;  ///< of the surface
    std::vector<SliceLine> border;   ///< of the image
};

/// The slices of the shown scene's image through a cross, and how they are shown. Slices are made
/// on a thread of their own, when they are shown and have changed. Used by the frame's thread; no
/// call blocks but the destructor, which waits for a slice.
class ImageSlices {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit ImageSlices(std::function<void()> wake);

    /// Follows the shown scene; once a frame. The image of a case that has just been opened without
    /// a surface is shown.
    /// \param scene null: keeps what is there
    /// \param followed the surface in the view, if it is another one than the scene's
    /// \return true if content() or figures() has changed
    bool update(const Scene* scene, const Surface* followed = nullptr);

    /// Forgets everything: the case is closed.
    void clear();

    [[nodiscard]] bool has_image() const { return !image_.empty(); }

    [[nodiscard]] bool has_mask() const { return mask_.has_value(); }

    /// True while a shown slice is not made yet.
    [[nodiscard]] bool pending() const;

    /// Why the last slices could not be made; empty: they were.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// Of the image.
    [[nodiscard]] const SliceGrid& grid() const { return grid_; }

    /// None: not known yet.
    [[nodiscard]] const std::optional<ImageFigures>& figures() const { return figures_; }

    /// True if the image holds labels, which are shown in colours.
    [[nodiscard]] bool shows_labels() const {
        return figures_ && figures_->kind == ImageKind::Labels;
    }

    /// The last one that was made; null: none yet.
    [[nodiscard]] const std::shared_ptr<const SliceContent>& content(SlicePlane plane) const {
        return contents_[number(plane)];
    }

    // --- what is shown

    /// Whether the row of 2D views is shown.
    [[nodiscard]] bool in_row() const { return (row_ || lent_row_) && has_image(); }

    void show_row(bool shown) {
        row_ = shown;
        lent_row_ = false;
    }

    /// Shows the row for as long as a form needs it; afterwards it is as it was before.
    void lend_row(bool shown) { lent_row_ = shown; }

    /// Whether a plane is shown in the 3D view.
    [[nodiscard]] bool in_space(SlicePlane plane) const {
        return space_[number(plane)] && has_image() && !(until_surface_ && surface_);
    }

    [[nodiscard]] bool any_in_space() const;

    void show_in_space(SlicePlane plane, bool shown) {
        space_[number(plane)] = shown;
        until_surface_ = false;
    }

    /// All planes.
    void show_in_space(bool shown) {
        space_.fill(shown);
        until_surface_ = false;
    }

    bool mask_shown = true;
    bool outline_shown = true;

    // --- where

    /// Where the planes meet, at the centre of a pixel [mm].
    [[nodiscard]] const Vec3& cross() const { return cross_; }

    void set_cross(const Vec3& point);

    [[nodiscard]] double position(SlicePlane plane) const { return cross_[axes_of(plane).normal]; }

    /// \param position on the plane's axis [mm]
    void move(SlicePlane plane, double position);

    /// So many slices along the plane's axis.
    void step(SlicePlane plane, int slices);

    // --- values

    [[nodiscard]] const GreyWindow& grey() const { return grey_; }

    /// Window and level until the image changes its kind, or reset_grey(). \param grey one with a
    /// window that is not above 0 is ignored
    void set_grey(const GreyWindow& grey);
    void reset_grey();

    /// The image's voxel at a place; none outside the image.
    [[nodiscard]] std::optional<float> value_at(const Vec3& point) const;

    /// The label at a place, of the mask or of an image of labels; none if there is none, or it
    /// is 0.
    [[nodiscard]] std::optional<int> label_at(const Vec3& point) const;

private:
    /// What a plane's content depends on.
    struct Wish {
        int image = 0, surface = 0;  ///< versions
        double position = 0.0;

        bool operator==(const Wish&) const = default;
    };

    struct Made {
        int image = 0;  ///< version
        ImageFigures figures;
        std::vector<std::shared_ptr<const SliceContent>> contents;
    };

    struct Order;

    [[nodiscard]] static std::size_t number(SlicePlane plane) {
        return static_cast<std::size_t>(plane);
    }

    [[nodiscard]] static Made made(Order order);
    void show_first_image(const std::optional<Surface>& surface);
    void take_image(const Image& image, const Scene& scene);
    void take_surface(const std::optional<Surface>& surface);
    void take_figures(const ImageFigures& figures);
    [[nodiscard]] bool take_made();
    void start();
    [[nodiscard]] Wish wish(SlicePlane plane) const;
    [[nodiscard]] bool outdated(SlicePlane plane) const;

    Image image_;
    std::optional<Image> mask_;
    std::optional<Surface> surface_;
    SliceGrid grid_;
    std::optional<ImageFigures> figures_;
    std::array<std::shared_ptr<const SliceContent>, 3> contents_;
    std::array<std::optional<Wish>, 3> had_;  ///< what the contents were made for
    int image_version_ = 0, surface_version_ = 0;
    bool row_ = false;
    bool lent_row_ = false;
    bool was_shown_ = false;      ///< the image of this case
    bool until_surface_ = false;  ///< the planes were not asked for
    std::array<bool, 3> space_ = {false, false, false};
    Vec3 cross_ = Vec3::Zero();
    GreyWindow grey_;
    bool typed_grey_ = false;  ///< grey_ is the user's
    Task<Made> task_;
    std::string problem_;
};

}  // namespace vesselbench
