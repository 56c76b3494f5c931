#pragma once

#include <array>
#include <memory>

#include "gpu/render/layers.h"
#include "workbench/window/features/slices/image_slices.h"
#include "workbench/window/style/theme.h"

namespace vesselbench {

/// Slices hide surfaces from the cursor: the layer of a plane is this and the plane's number.
inline constexpr std::uint32_t kFirstSliceLayer = 100;

/// The colour of a plane's border and of its line in the other slices: as its axis has in the
/// orientation letters.
[[nodiscard]] Paint paint_of(SlicePlane plane);

/// Colours of contours are linear, those of the window are not.
[[nodiscard]] Colour linear(Paint colour);

/// The image's slices on the device, for the 3D view and for the 2D views.
class SlicePlanes {
public:
    /// Uploads slices that have changed; once a frame. Needs the window's OpenGL context, as the
    /// destructor does.
    void update(const ImageSlices& slices);

    /// Counts changes of alone().
    [[nodiscard]] int version() const { return version_; }

    /// Counts changes of what add_to() adds.
    [[nodiscard]] int space_version() const { return space_version_; }

    /// True if the 3D view shows a plane.
    [[nodiscard]] bool any_in_space() const;

    /// The planes of the 3D view. \param width of lines [pixels]
    void add_to(Layers& layers, double width) const;

    /// One plane alone; empty if it is not made yet.
    [[nodiscard]] Layers alone(SlicePlane plane, double width) const;

private:
    /// A plane's slice, as uploaded.
    struct Drawn {
        std::shared_ptr<const SliceContent> content;
        std::shared_ptr<DrawnSlice> image, mask;
        std::shared_ptr<const DrawnLines> outline, border;
    };

    /// How slices are shown, besides their content.
    struct Look {
        GreyWindow grey;
        std::array<bool, 3> in_space = {false, false, false};
        bool labels = false, mask = false, outline = false;

        bool operator==(const Look&) const = default;
    };

    static void upload(Drawn& drawn, std::shared_ptr<const SliceContent> content, Paint colour);
    void add_slices(Layers& layers, const Drawn& drawn, SlicePlane plane) const;
    void add_outline(Layers& layers, const Drawn& drawn, double width) const;
    static void add_lines(Layers& layers, const Drawn& drawn,
                          const std::shared_ptr<const DrawnLines>& lines, double width);

    std::array<Drawn, 3> planes_;
    Look look_;
    int version_ = 0, space_version_ = 0;
};

}  // namespace vesselbench
