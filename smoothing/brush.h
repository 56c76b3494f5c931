#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/surface.h"
#include "geometry/surface_distance.h"
#include "smoothing/geodesic_neighbourhood.h"

namespace vesselbench {

/// A place that outlives changes of the surface before it: it is no vertex, but a point with the
/// surface's outward normal and the vessel's radius there.
struct Anchor {
    Vec3 point = Vec3::Zero();    ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< outward, any length but 0
    double radius = 1.0;          ///< local radius of the vessel [mm], > 0
};

/// How a brush fades from its middle (t = 0) to its edge (t = 1).
enum class Falloff : std::uint8_t {
    Smooth,    ///< (1 - t^2)^2
    Linear,    ///< 1 - t
    Constant,  ///< 1
};

enum class BrushKind : std::uint8_t {
    Smooth,   ///< Laplace passes: a vertex goes strength * falloff of the way to its ring's mean
    Inflate,  ///< along the vertex normals by strength * falloff * 0.1 radius; negative deflates
    Weight,   ///< adds strength * falloff to a vertex attribute in [0, 1]; negative takes away
};

/// One touch of a brush.
struct Dab {
    Anchor anchor;
    double radius = 1.0;    ///< reach along the surface [mm], > 0
    double strength = 0.5;  ///< [-1, 1], [0, 1] for smoothing [-]
    Falloff falloff = Falloff::Smooth;
};

struct BrushSettings {
    BrushKind kind = BrushKind::Smooth;
    int passes = 4;                            ///< Laplace passes a dab, 1 ... 100
    std::string attribute = "painted_weight";  ///< that BrushKind::Weight paints; made when absent
};

/// A brush stroke, dab by dab. Its result depends on the dabs only, not on when each came in, so
/// that a stroke on the screen and its replay have the same bits.
/// The brush reaches along the surface, never through to another vessel. Vertices of patches other
/// than the wall (so the caps with their rims) and of open boundaries are painted, but not moved.
class BrushStroke {
public:
    /// \param places of the surface's start, when they are known already; made if null
    /// \throw InvalidInput if the surface is empty or a position is not finite, or the settings are
    ///        out of their ranges
    BrushStroke(Surface surface, BrushSettings settings,
                std::shared_ptr<const SurfaceDistance> places = nullptr);

    /// Touches the surface, as the dabs before left it, at the nearest place within one local
    /// radius of the anchor whose normal is within 60 degrees of the anchor's.
    /// \return vertices that the dab changed, ascending
    /// \throw InvalidInput if the dab is out of its ranges
    /// \throw AlgorithmFailure if there is no such place; the stroke stays as it was
    std::vector<VertexId> add(const Dab& dab);

    /// The surface with all dabs so far.
    [[nodiscard]] Surface surface() const;

private:
    [[nodiscard]] SurfacePoint resolve(const Anchor& anchor) const;
    void smooth();
    void inflate(double length);
    void paint();
    [[nodiscard]] Vec3 vertex_normal(VertexId v) const;

    struct Touched {
        VertexId vertex;
        double factor;  ///< strength * falloff
    };

    Surface start_;
    BrushSettings settings_;
    std::shared_ptr<const SurfaceDistance> places_;  ///< of the start
    GeodesicNeighbourhood neighbourhood_;
    std::vector<std::uint8_t> fixed_;  ///< #V
    Positions now_;                    ///< [mm], #V
    std::vector<double> weights_;      ///< #V for BrushKind::Weight, else empty
    double farthest_ = 0.0;            ///< largest displacement since the start [mm]
    std::vector<Touched> touched_;     ///< by the dab in work, ascending
    Positions moved_;                  ///< where they go, in their order
};

}  // namespace vesselbench
