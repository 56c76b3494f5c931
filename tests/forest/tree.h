#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/vec3.h"

namespace vesselbench::forest {

/// What a case is given to the program as.
enum class CaseKind { OpenSurface, ClosedSurface, VoxelSurface, MaskImage, IntensityImage };

[[nodiscard]] std::string to_string(CaseKind kind);
[[nodiscard]] bool is_image(CaseKind kind);

/// How a vessel ends. In a closed surface or an image, a flat or oblique end is a flat closure; in
/// an open one it is a flat rim.
enum class EndKind {
    Flat,       ///< cut across the vessel
    Oblique,    ///< cut flat, 15 to 50 degrees off
    Ragged,     ///< an open rim of whole triangles, up to half a diameter apart along the vessel
    Furcation,  ///< cut flat through the place where it divides
    Rounded,    ///< closed by a half sphere
    Border,     ///< cut by the image's border
};

[[nodiscard]] std::string to_string(EndKind kind);

/// A point of a centerline with the vessel's radius there.
struct LinePoint {
    Vec3 at = Vec3::Zero();  ///< [mm]
    double radius = 1.0;     ///< [mm]
};

using Line = std::vector<LinePoint>;

/// The true end of a vessel.
struct End {
    EndKind kind = EndKind::Flat;
    Vec3 place = Vec3::Zero();  ///< on the centerline; of a rounded end its outermost point [mm]
    Vec3 direction = Vec3::Zero();   ///< of the centerline there, outward, unit
    Vec3 rim_normal = Vec3::Zero();  ///< of a flat rim or closure, outward; zero: not flat
    double radius = 0.0;             ///< [mm]
    double whole_to = 0.0;  ///< distance along the branch up to which sections are whole [mm]
    double ragged = 0.0;    ///< [mm] amplitude of a ragged rim
    bool inlet = false;
    bool optional = false;  ///< open, closed and removed are all right
    std::string why;        ///< of `optional`
};

/// A vessel between two nodes, or from a node to its end.
struct Branch {
    Line line;            ///< from from_node; beyond `length` only helps to shape
    double length = 0.0;  ///< up to to_node or the true end [mm]
    std::size_t from_node = 0;
    std::optional<std::size_t> to_node;  ///< none: it has an end
    std::optional<End> end;
    double free_from = 0.0;  ///< [mm] from here on its line is outside its neighbours
    std::optional<std::size_t> ghost_node;  ///< where the ghosts of its end leave it
    bool ghost = false;                     ///< shapes an end in a furcation; not in the truth
    bool resolved = true;                   ///< thick enough for the image's voxels
};

/// A furcation.
struct Node {
    Vec3 at = Vec3::Zero();
    double reach = 0.0;  ///< [mm] how far its fillets reach
    double blend = 0.0;  ///< [mm] width of the fillets
};

/// A saccular aneurysm.
struct Sac {
    Vec3 centre = Vec3::Zero();  ///< [mm]
    double radius = 1.0;         ///< [mm]
    double blend = 0.0;          ///< [mm]
};

/// Two vessels that touch without being joined.
struct Kiss {
    std::size_t first = 0, second = 0;  ///< branches
    Vec3 place = Vec3::Zero();
    double gap = 0.0;  ///< [mm]
};

struct Tree {
    std::vector<Branch> branches;  ///< the first is the trunk, from its furcation to the inlet
    std::vector<Node> nodes;
    std::vector<Sac> sacs;
    std::vector<Kiss> kisses;
    int loops = 0;
    /// Half space that an image shows, through the trunk's end; none: all of it.
    std::optional<Eigen::Hyperplane<double, 3>> border;
};

/// Distance along a line to each of its points [mm].
[[nodiscard]] std::vector<double> abscissas(const Line& line);
[[nodiscard]] LinePoint at_abscissa(const Line& line, double s);
/// Unit tangent; smooth from point to point.
[[nodiscard]] Vec3 tangent_at(const Line& line, double s);
[[nodiscard]] double length_of(const Line& line);

/// The part of a line from s to t, with both ends [mm].
[[nodiscard]] Line part_of(const Line& line, double s, double t);

}  // namespace vesselbench::forest
