#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The three planes of the patient.
enum class SlicePlane { Axial, Coronal, Sagittal };

inline constexpr std::array<SlicePlane, 3> kSlicePlanes = {SlicePlane::Axial, SlicePlane::Coronal,
                                                           SlicePlane::Sagittal};

/// How a slice lies on the screen, in patient directions (LPS): axial ones are seen from the feet
/// with the front above, coronal ones from the front, sagittal ones from the patient's left.
struct SliceAxes {
    const char* name;  ///< "Axial"
    const char* key;   ///< for names of items: "axial"
    int across;       ///< the patient axis (0 to 2) along the screen's rows, which grows rightwards
    int along;        ///< along the screen's columns
    bool along_down;  ///< that axis grows downwards; else upwards
    int normal;       ///< the axis on which slices have their position
};

[[nodiscard]] const SliceAxes& axes_of(SlicePlane plane);

[[nodiscard]] Vec3 right_of(SlicePlane plane);  ///< unit, on the screen
[[nodiscard]] Vec3 up_of(SlicePlane plane);     ///< unit, on the screen

/// The side of the patient that a direction (LPS) points to most: 'L', 'R', 'A', 'P', 'S' or 'I'.
[[nodiscard]] char patient_letter(const Vec3& direction);

/// A position on a patient axis (0 to 2) as a text: "S 12.5 mm" for 12.5 on axis 2.
[[nodiscard]] std::string position_text(int axis, double position);

/// The pixels of slices: boxes along the patient's axes that cover an image. Along the axes of an
/// image that is not oblique, they are its voxels; else cubes as small as its shortest voxel edge.
struct SliceGrid {
    Vec3 low = Vec3::Zero();   ///< outer corner of the first pixel [mm]
    Vec3 step = Vec3::Ones();  ///< [mm]
    std::array<int, 3> count = {0, 0, 0};

    [[nodiscard]] Vec3 high() const;

    /// The nearest centre of a pixel along an axis [mm].
    [[nodiscard]] double snapped(int axis, double position) const;
    [[nodiscard]] Vec3 snapped(const Vec3& point) const;

    bool operator==(const SliceGrid&) const = default;
};

/// \param image not empty
[[nodiscard]] SliceGrid slice_grid(const Image& image);

/// Values of one plane; not a number outside the image.
struct ImageSlice {
    Vec3 corner = Vec3::Zero();  ///< outer corner of the first pixel, upper left on the screen [mm]
    Vec3 across = Vec3(1, 0, 0);  ///< from there along a row, over its whole length [mm]
    Vec3 down = Vec3(0, 1, 0);    ///< along the columns [mm]
    int columns = 0, rows = 0;
    std::vector<float> values;  ///< rows x columns, a row after the other
};

/// Values between voxels.
enum class Between {
    Nearest,  ///< the nearest voxel's: labels
    Linear
};

/// \param position of the plane on its axis [mm]
[[nodiscard]] ImageSlice slice_of(const Image& image, const SliceGrid& grid, SlicePlane plane,
                                  double position, Between between);

/// The voxel at a place [mm]; none outside the image.
[[nodiscard]] std::optional<float> voxel_at(const Image& image, const Vec3& point);

/// Which values are shown as black and white.
struct GreyWindow {
    double window = 1.0;  ///< from black to white, above 0 [image's unit]
    double level = 0.5;   ///< middle grey [image's unit]

    bool operator==(const GreyWindow&) const = default;
};

/// What is known about an image's values.
struct ImageFigures {
    ImageKind kind = ImageKind::Intensity;
    double least = 0.0, most = 0.0;
    GreyWindow automatic;  ///< intensities: all but the 0.5 % at either end; labels: 0 to the most
};

/// \param image not empty
[[nodiscard]] ImageFigures figures_of(const Image& image);

/// A curve in a slice.
struct SliceLine {
    Positions points;  ///< [mm]
    bool closed = false;
};

/// Where a plane cuts a surface.
[[nodiscard]] std::vector<SliceLine> outline_of(const Surface& surface, SlicePlane plane,
                                                double position);

/// The border of a plane's part inside the image; empty if there is none.
[[nodiscard]] std::vector<SliceLine> border_of(const Image& image, SlicePlane plane,
                                               double position);

}  // namespace vesselbench
