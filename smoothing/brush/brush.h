#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "smoothing/brush/geodesic_neighbourhood.h"
#include "smoothing/filters/new_crossings.h"

namespace vesselbench {

/// A place that survives changes of the surface before it: not a vertex, but a point with the
/// surface's outward normal and the vessel's radius there.
struct Anchor {
    Vec3 point = Vec3::Zero();    ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< outward, any length but 0
    double radius = 1.0;          ///< local radius of the vessel [mm], > 0
};

/// The anchor of the surface point nearest to a given point: the outward normal there, and half the
/// distance across the vessel as local radius.
/// \param places of the same surface
/// \param otherwise local radius [mm] if nothing lies across
/// \throw InvalidInput if the point is not finite
/// \throw AlgorithmFailure if the triangle there has no area
[[nodiscard]] Anchor nearest_anchor(const Surface& surface, const SurfaceDistance& places,
                                    const Vec3& point, double otherwise);

enum class BrushKind : std::uint8_t {
    Smooth,   ///< Laplace passes: a vertex moves strength * falloff of the way to its one-ring mean
    Inflate,  ///< along the vertex normals by strength * falloff * 0.1 radius; negative deflates
    Weight,   ///< adds strength * falloff to a vertex attribute in [0, 1]; negative subtracts
};

/// One dab of a brush.
struct Dab {
    Anchor anchor;
    double radius = 1.0;    ///< reach along the surface [mm], > 0
    double strength = 0.5;  ///< [-1, 1], [0, 1] for smoothing [-]
    /// Fraction of the radius, from the edge inward, over which the brush fades [-], 0 ... 1: as (1
    /// - s^2)^2 with s from 0 to 1 across it. 1 fades from the centre, 0 has a sharp edge.
    double falloff = 1.0;
};

/// Fraction of its strength that a dab has at a distance along the surface [mm].
[[nodiscard]] double falloff_share(const Dab& dab, double distance);

struct BrushSettings {
    BrushKind kind = BrushKind::Smooth;
    int passes = 4;                            ///< Laplace passes per dab, 1 ... 100
    std::string attribute = "painted_weight";  ///< painted by BrushKind::Weight; created if absent
};

/// A brush stroke, dab by dab. Its result depends only on the dabs, not on how they are batched, so
/// a stroke on the screen and its replay have the same bits. The brush reaches along the surface,
/// never through to another vessel. Vertices of patches other than the wall (that is, caps with
/// their rims) and of open boundaries are painted, but not moved.
class BrushStroke {
public:
    /// \param places of the initial surface, if known already; built if null
    /// \throw InvalidInput if the surface is empty or a position is not finite, or the settings are
    /// out of their ranges
    BrushStroke(Surface surface, BrushSettings settings,
                std::shared_ptr<const SurfaceDistance> places = nullptr);

    /// Applies a dab to the surface as left by earlier dabs, at the nearest place within one local
    /// radius of the anchor whose normal is within 60 degrees of the anchor's.
    /// \return vertices that the dab changed, ascending
    /// \throw InvalidInput if the dab is out of its ranges
    /// \throw AlgorithmFailure if there is no such place; the stroke is unchanged
    std::vector<VertexId> add(const Dab& dab);

    /// Ends the stroke: it is reverted where it made the wall pass through itself or another
    /// one.
    TakenBack keep_walls_apart(const Progress& progress = {});

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
    std::shared_ptr<const SurfaceDistance> places_;  ///< of the initial surface
    GeodesicNeighbourhood neighbourhood_;
    std::vector<std::uint8_t> fixed_;  ///< #V
    Positions now_;                    ///< [mm], #V
    std::vector<double> weights_;      ///< #V for BrushKind::Weight, else empty
    double farthest_ = 0.0;            ///< largest displacement since the start [mm]
    std::vector<Touched> touched_;     ///< by the current dab, ascending
    Positions moved_;                  ///< where they move, in their order
};

}  // namespace vesselbench
