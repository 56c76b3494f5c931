#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A vessel: circular cross-sections along a smooth curve (centripetal Catmull-Rom) through the
/// points.
struct VesselShape {
    Positions points;           ///< [mm], at least 2
    std::vector<double> radii;  ///< [mm], one per point, > 0
    bool flat_ends = false;     ///< cut flat at both ends; else rounded
};

struct SphereShape {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 1.0;         ///< [mm]
};

struct BoxShape {
    Vec3 centre = Vec3::Zero();     ///< [mm]
    Vec3 half_size = Vec3::Ones();  ///< [mm]
};

struct TorusShape {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    Vec3 axis = Vec3::UnitZ();
    double ring_radius = 10.0;  ///< [mm]
    double tube_radius = 2.0;   ///< [mm]
};

/// One solid of a phantom; a fillet joins it to the parts before it.
struct PhantomPart {
    std::string name;
    std::variant<VesselShape, SphereShape, BoxShape, TorusShape> shape;
    double blend = 0.0;  ///< [mm] width of the fillet towards the parts before; 0: a sharp edge
};

/// Two parts that the expert's mask separates although they blend in the image (thesis Fig.
/// 5.14).
struct KeptApart {
    std::string first, second;  ///< names of parts
    double gap = 0.0;  ///< [mm] width of the strip around their mid-surface left out of the mask
};

/// Voxels [from, to] (both included) set to background before blurring (thesis 5.4.2: deleted parts
/// of slices).
struct Deletion {
    std::array<int, 3> from = {0, 0, 0};
    std::array<int, 3> to = {0, 0, 0};
};

/// A loss of contrast within a vessel, as of contrast agent that has not spread: largest at the
/// centre's section, and none beyond the reach (a cosine bell). The lumen keeps its width.
struct ContrastDip {
    std::string part;            ///< name of the vessel
    Vec3 centre = Vec3::Zero();  ///< on the vessel's axis [mm]
    double reach = 1.0;          ///< from the centre [mm], > 0
    double core = 0.0;  ///< [-] relative loss on the axis; between axis and wall, it grows with the
                        ///< square of the distance from the axis
    double wall = 0.0;  ///< [-] relative loss at the wall
};

/// How the phantom is imaged and manually segmented.
struct PhantomImaging {
    Vec3 spacing = Vec3::Constant(0.5);      ///< [mm] along i, j, k
    std::optional<std::array<int, 3>> size;  ///< voxels; absent: the phantom's box plus margin
    double margin = 3.0;  ///< [mm] around the phantom; negative: vessels leave the image
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: directions of i, j, k
    double inside = 1000.0;                              ///< intensity of contrast agent
    double outside = 0.0;                                ///< intensity of tissue
    Vec3 blur = Vec3::Zero();    ///< [mm] standard deviation of the point spread along i, j, k
    double noise = 0.0;          ///< standard deviation of the intensity noise
    double inhomogeneity = 0.0;  ///< [-] largest relative loss of contrast, slowly varying
    std::vector<ContrastDip> dips;
    std::vector<Deletion> deletions;
    int mask_slice_step = 1;   ///< contours are drawn on every n-th slice and copied to the others
    double mask_jitter = 0.0;  ///< [mm] standard deviation of the drawn contour's offset, per slice
    std::vector<KeptApart> kept_apart;
};

/// A phantom with a known surface, described as data.
struct PhantomDescription {
    std::string name;
    std::vector<PhantomPart> parts;
    std::vector<PhantomPart> neighbours;  ///< another structure near it (distance awareness)
    PhantomImaging imaging;
    double surface_edge = 0.2;   ///< [mm] edge of the exact surface's triangles
    double surface_noise = 0.0;  ///< [mm] standard deviation of noise on the "noisy" surface
    std::uint64_t seed = 1;
};

}  // namespace vesselbench
