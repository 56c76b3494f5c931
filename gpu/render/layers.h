#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/colours.h"
#include "gpu/render/overlays.h"
#include "gpu/render/surface_source.h"
#include "gpu/render/view_camera.h"

namespace vesselbench {

/// What a surface's colour shows.
enum class Colouring {
    Base,     ///< one colour
    Patches,  ///< a colour for each patch label
    Values,   ///< its values through a colour map
    Vertices  ///< its vertices' colours
};

enum class Edges { Off, Over, Only };

/// A surface and how it is shown. Colours are linear RGB.
struct SurfaceLayer {
    std::shared_ptr<const SurfaceSource> source;
    std::uint32_t id = 0;  ///< what picking names; 0: it cannot be picked

    Detail detail = Detail::Full;  ///< Coarse: for layers without edges

    Colouring colouring = Colouring::Base;
    Colour base = kWallColour;
    std::vector<Colour> patch_colours;  ///< by label, of at most 1024 labels; missing ones: base
    ColourMap map = ColourMap::Ordered;
    double least = 0.0, most = 1.0;           ///< values at the ends of the map
    Colour no_value = {0.35F, 0.35F, 0.35F};  ///< for values that are not a number
    Colour back = {0.50F, 0.20F, 0.17F};      ///< for triangles seen from inside
    bool back_as_front = false;               ///< inner sides in the same colours instead
    double opacity = 1.0;                     ///< [-] below 1: drawn after opaque layers, in order

    Edges edges = Edges::Off;
    Colour edge_colour = {0.06F, 0.03F, 0.025F};
    double edge_opacity = 0.75;  ///< [-] of large triangles; dense edges are paler
    double edge_width = 1.0;     ///< [pixels]

    bool flat = false;              ///< one normal per triangle instead of smooth shading
    double pull = 0.0;              ///< how much nearer to the eye it is for hiding others [mm]
    bool clipped = true;            ///< by the view's clip plane
    std::optional<Colour> section;  ///< fills the cut by the clip plane; for closed surfaces
    std::optional<std::uint32_t> highlighted_patch;  ///< label of a patch to be lit up
    bool highlighted = false;                        ///< all of it is lit up
};

/// Polylines of one width.
struct LinesLayer {
    std::shared_ptr<const DrawnLines> lines;
    std::uint32_t id = 0;
    double width = 2.0;           ///< [pixels]
    double opacity = 1.0;         ///< [-]
    double hidden_opacity = 0.0;  ///< [-] of what is behind surfaces; 0: hidden
    double pull = 0.0;            ///< as of SurfaceLayer [mm]
    bool clipped = false;
    std::optional<std::uint32_t> highlighted;  ///< a segment to be lit up
};

/// Marks of places.
struct PointsLayer {
    std::shared_ptr<const DrawnPoints> points;
    std::uint32_t id = 0;
    double opacity = 1.0;                      ///< [-]
    double hidden_opacity = 0.35;              ///< [-] of what is behind surfaces; 0: hidden
    std::optional<std::uint32_t> highlighted;  ///< a mark to be lit up
};

/// A slice of an image. It has holes where its scalars are not numbers.
struct SliceLayer {
    std::shared_ptr<const DrawnSlice> slice;
    std::uint32_t id = 0;
    double window = 1.0, level = 0.5;  ///< black to white, and the middle of it [scalar's unit]
    double opacity = 1.0;              ///< [-]
    bool smooth = true;                ///< interpolates between pixels
    bool labels = false;  ///< whole numbers as category_colour of them; holes where they are 0
};

/// All that a view shows. Slices and opaque surfaces, then transparent surfaces, lines and points.
struct Layers {
    std::vector<SurfaceLayer> surfaces;
    std::vector<SliceLayer> slices;
    std::vector<LinesLayer> lines;
    std::vector<PointsLayer> points;
};

/// The smallest sphere around the spheres of all layers, roughly; radius 0 if there is none.
[[nodiscard]] Sphere bounds_of(const Layers& layers);

/// Removes the half space that the normal points to.
struct ClipPlane {
    Vec3 point = Vec3::Zero();  ///< [mm]
    Vec3 normal = Vec3(0, 0, 1);
};

/// Part of a framebuffer [pixels], from its lower left corner.
struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;

    [[nodiscard]] double aspect() const {
        return height > 0 ? static_cast<double>(width) / height : 1.0;
    }
};

/// Colours behind everything, above and below; the same twice: one colour.
struct Background {
    Colour above = {1.0F, 1.0F, 1.0F}, below = {1.0F, 1.0F, 1.0F};
};

/// What of a layer is picked; larger ones win near the cursor.
enum class PickKind : std::uint32_t { Nothing, Surface, Slice, Line, Point };

/// How layers are seen, and where they are drawn.
struct SceneView {
    ViewCamera camera;
    PixelRectangle rectangle;
    std::optional<ClipPlane> clip;
    std::optional<Background> background = Background{};  ///< none: keeps what is there
};

}  // namespace vesselbench
