#pragma once

#include <optional>
#include <string>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/measure.h"
#include "workbench/colours/colourings.h"

namespace vesselbench {

/// What the view shows besides the surface; remembered from one start to the next.
struct ShownLayers {
    bool edges = false;        ///< of the triangles
    bool flat = false;         ///< shading
    bool source = false;       ///< the source's surface as a wireframe
    bool centerlines = false;  ///< with circles of the local radius
    bool names = false;        ///< of the patches, at their openings
    bool anchors = false;      ///< the places of edits

    bool operator==(const ShownLayers&) const = default;
};

/// The direction across the clip plane.
enum class ClipAxis { Sagittal, Coronal, Axial, Camera };

struct ClipChoice {
    bool on = false;
    ClipAxis axis = ClipAxis::Coronal;
    double place = 0.5;  ///< of the way through the model, in [0, 1] [-]
    bool flipped = false;

    bool operator==(const ClipChoice&) const = default;
};

/// The plane of a clipped model; its normal points to the half that is removed.
/// \param view direction from the eye, for planes that face the camera
[[nodiscard]] std::optional<Plane> clip_plane(const ClipChoice& choice, const Bounds& box,
                                              const Vec3& view);

/// Whether the plane is to be flipped so that the half before the section is removed.
/// \param view direction from the eye
[[nodiscard]] bool hides_section(ClipAxis axis, const Vec3& view);

/// What clicks on the model and in slices are for, unless a parameter of the form takes them.
enum class ClickTool {
    None,
    Distance,       ///< measures, kept with the project
    Diameter,       ///< likewise
    ReviewPin,      ///< a mark of a reviewer's verdict
    ReviewDistance  ///< likewise
};

[[nodiscard]] constexpr bool is_measuring(ClickTool tool) {
    return tool == ClickTool::Distance || tool == ClickTool::Diameter;
}

[[nodiscard]] constexpr bool is_reviewing(ClickTool tool) {
    return tool == ClickTool::ReviewPin || tool == ClickTool::ReviewDistance;
}

/// What the drawn colours show.
struct DrawnQuantity {
    ColouringKind kind = ColouringKind::Patches;
    bool compared = false;  ///< the distance from a comparison's reference, whatever the kind

    bool operator==(const DrawnQuantity&) const = default;
};

/// How the user looks at the case, kept as long as the case is open.
struct ViewChoice {
    ColouringKind colouring = ColouringKind::Patches;
    ColouringKind last_colouring = ColouringKind::Deviation;  ///< other than patches
    std::string least, most;              ///< typed ends of the colours' range; empty: automatic
    std::optional<ValueRange> automatic;  ///< range of what is drawn; none: not known
    bool transparent = false;
    ClipChoice clip;
    bool flies = false;  ///< through the lumen
    ClickTool tool = ClickTool::None;

    /// With the automatic range.
    void choose(ColouringKind kind);

    /// \param has_cells the section of a volume mesh shows its cells, unless other colours are
    /// chosen
    void switch_clip(bool has_cells);

    /// Once a frame: what the view draws, with its automatic range. The typed range of another
    /// quantity is forgotten.
    void draw_as(const DrawnQuantity& quantity, const std::optional<ValueRange>& range);

    [[nodiscard]] bool has_typed_range() const { return !least.empty() || !most.empty(); }

    /// The typed range; none: nothing is typed, or it makes no sense.
    [[nodiscard]] std::optional<ValueRange> range() const;

    void forget_range();

private:
    DrawnQuantity drawn_;
};

}  // namespace vesselbench
