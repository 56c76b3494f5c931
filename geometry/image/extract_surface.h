#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/image/border_grazes.h"
#include "geometry/image/image.h"
#include "geometry/image/level_field.h"
#include "geometry/image/threshold.h"
#include "geometry/image/voxel_topology.h"
#include "geometry/kernel/piece_shape.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// How the inside of the vessel is determined from the image.
enum class ExtractionMethod {
    Threshold,  ///< intensities or a level set: inside above (or below) the threshold
    Labels,     ///< chosen labels of a label map or mask
    Masked,     ///< intensities inside a dilated mask (thesis Fig. 3.7)
    Wall        ///< a drawn mask's surface, refined by the image (drawn_wall.h)
};

/// The voxels of labels or a mask alone decide about the inside: there is no threshold.
[[nodiscard]] bool takes_voxels(ExtractionMethod method);

/// "threshold", "labels", "masked", "wall"
[[nodiscard]] std::string to_string(ExtractionMethod method);

/// Where the surface of a mask or of labels lies between the voxels.
enum class MaskSurface {
    Midway,  ///< midway between voxel centres: keeps all staircases
    Smooth,  ///< where it bends least (separating_field.h): no staircases, the same topology
    /// As smooth, but no vessel is narrower than its voxels, or broken where they touch at edges
    /// and corners only (voxel_chains.h), missing voxels are filled (missing_voxels.h), and none
    /// ends where its wall touches the image's border (border_grazes.h).
    Lumen
};

/// How the surface of a mask runs from slice to slice where slices are thick (curved_field.h).
enum class BetweenSlices {
    Straight,  ///< between neighbouring voxels
    Curved     ///< as smoothly as within them
};

/// Cleaning of the image (thesis 3.2.3), in this order; 0 skips a step.
struct Cleaning {
    int diffusion = 0;                         ///< iterations of edge-preserving diffusion
    std::optional<double> diffusion_contrast;  ///< absent: estimated from the image
    double gaussian = 0.0;                     ///< standard deviation [mm]
    int opening = 0;                           ///< radius [voxels]
    int closing = 0;                           ///< radius [voxels]

    [[nodiscard]] bool any() const {
        return diffusion > 0 || gaussian > 0.0 || opening > 0 || closing > 0;
    }

    bool operator==(const Cleaning&) const = default;
};

/// Which bodies of the iso-surface are kept.
enum class Bodies { Largest, All };

/// Parameters of extract_surface; absent ones are decided from the image.
struct ExtractionParameters {
    std::optional<ExtractionMethod> method;
    std::optional<double> threshold;  ///< image value; a level set's iso-value
    bool local_levels = false;  ///< of intensities, starting from the threshold (level_field.h)
    std::optional<bool> inside_below;  ///< the vessel has the values below the threshold
    std::vector<int> labels;           ///< empty: any label above 0
    /// Of labels, and of a drawn wall, which is never midway; other methods ignore it.
    MaskSurface mask_surface = MaskSurface::Midway;
    BetweenSlices between_slices = BetweenSlices::Straight;  ///< of a smooth surface of a mask
    FreedSides freed_sides = FreedSides::All;                ///< of MaskSurface::Lumen
    int dilation = 1;  ///< radius of the mask's dilation [voxels] (3 x 3 x 3 kernel)
    Cleaning cleaning;
    std::optional<double> resample;  ///< edge of cubic voxels [mm]
    std::optional<Vec3> seed;        ///< the body at this point [mm], LPS
    Bodies bodies = Bodies::Largest;
    bool with_topology = true;  ///< finds Extraction::before and after
};

/// What a mask needed for its lumen (MaskSurface::Lumen).
struct KeptLumen {
    std::size_t grazes = 0;     ///< places where its wall touches the image's border
    int closing = 0;            ///< radius of the closing that filled missing voxels [voxels]
    double filled = 0.0;        ///< [-] voxels that it added, of those before
    std::int64_t loops = 0;     ///< before it
    std::size_t joined = 0;     ///< voxels added between those that touch at edges and corners
    std::size_t chain = 0;      ///< voxels at which a vessel is one voxel wide
    Vec3 place = Vec3::Zero();  ///< of the middle one of these [mm]
};

/// How far a surface's wall lies from the mask's: of `wall` from its smooth surface, else from the
/// one midway between voxels.
struct MaskDistance {
    double mean = 0.0;     ///< [mm]
    double largest = 0.0;  ///< [mm]
    double seen = 0.0;     ///< [-] of the wall at which the image has an edge; of `wall` only
};

/// A surface, and the decisions and findings on the way.
struct Extraction {
    Surface surface;    ///< closed, outward, [mm]; flat closures at the border are patches cut_1...
    Sampling sampling;  ///< of the grid it was extracted on
    ExtractionMethod method = ExtractionMethod::Threshold;
    double threshold = 0.0;
    bool inside_below = false;
    MaskSurface mask_surface = MaskSurface::Midway;
    std::optional<KeptLumen> lumen;
    BetweenSlices between_slices = BetweenSlices::Straight;
    std::vector<int> labels;              ///< that are inside
    std::optional<double> contrast;       ///< of the diffusion, if it ran
    std::optional<WallLevels> levels;     ///< that took the threshold's place
    std::string why_no_levels;            ///< empty unless they were wanted and not found
    std::vector<std::string> reasons;     ///< one sentence for each decision
    std::optional<VoxelTopology> before;  ///< of the inside voxels, if there was any cleaning
    std::optional<VoxelTopology> after;
    std::size_t bodies = 0;                    ///< found
    std::size_t hollows = 0;                   ///< found
    double largest_dropped = 0.0;              ///< [mm^3]
    std::optional<PieceShape> dropped_vessel;  ///< the longest body dropped that is a vessel
    std::optional<MaskDistance> from_mask;     ///< of methods that use a mask beside the image
};

/// Makes a surface from an image (thesis 3.2): a threshold on intensities, chosen labels,
/// intensities inside a dilated mask, or a mask's surface refined by intensities. Where the vessel
/// leaves the image, by at least two voxel faces, it is closed flat by a patch of kind Cut.
/// \param mask on the image's grid, inside where > 0, or nothing
/// \throw InvalidInput if the image is empty or constant, a mask is on another grid, or a label
/// does not occur
/// \throw AlgorithmFailure if no voxel or every voxel is inside, or no body is at the seed
[[nodiscard]] Extraction extract_surface(const Image& image, const std::optional<Image>& mask,
                                         const ExtractionParameters& parameters,
                                         const Progress& progress = {});

/// The same for one image with changing parameters, as for a sliding iso-value: the classified,
/// cleaned and resampled image is kept while its own parameters are unchanged. Not thread-safe.
class SurfaceExtractor {
public:
    /// \throw InvalidInput as extract_surface
    SurfaceExtractor(Image image, std::optional<Image> mask);
    ~SurfaceExtractor();
    SurfaceExtractor(SurfaceExtractor&&) noexcept;

    /// The parameters with method, side, threshold and local levels decided as extract() would, so
    /// that another image of the same content, such as a coarser one, is treated alike.
    /// \throw as extract_surface
    [[nodiscard]] ExtractionParameters decided(ExtractionParameters parameters,
                                               const Progress& progress = {});

    /// \throw as extract_surface
    [[nodiscard]] Extraction extract(const ExtractionParameters& parameters,
                                     const Progress& progress = {});

    /// By how much the volume at one threshold is expected to differ from that at local levels, as
    /// a fraction of the latter; none for labels and level sets, or where there are no such levels.
    /// \throw as extract_surface
    [[nodiscard]] std::optional<double> volume_error(const ExtractionParameters& parameters,
                                                     const Progress& progress = {});

private:
    struct Source;
    std::unique_ptr<Source> source_;
};

}  // namespace vesselbench
