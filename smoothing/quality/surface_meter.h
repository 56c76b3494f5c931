#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/kernel/local_error.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"
#include "smoothing/filters/linear_step.h"
#include "smoothing/quality/quality_measures.h"

namespace vesselbench {

/// What is seen of a state while it is smoothed: the figures of `smooth`, within rounding.
struct SeenMeasures {
    LocalError error;                   ///< at the places of a state
    double volume = 0.0;                ///< [mm^3]
    double normal_curvature_deg = 0.0;  ///< mean over the vertices (thesis 5.4.1)
};

/// Measures states of one surface against their original, repeatedly: all measures in two passes
/// over the vertices, on all threads, about the time of 20 sweeps of a filter. Bit-identical for
/// any number of threads. The numbers are those of geometry/kernel/local_error.h and
/// geometry/kernel/measure.h, except for the signed curvature: here H is the component of the
/// curvature normal along the vertex normal (weighted by area), there its full length with that
/// component's sign, which differs where slivers fold.
class SurfaceMeter {
public:
    /// Positions in memory: 4 numbers each, so that a vertex fills one register.
    using Packs = std::span<const PackRow>;

    /// \param planes measures error_thesis too
    /// \param order the vertex at every place, if states are not in the order of the vertices;
    /// empty: they are
    /// \throw InvalidInput if a length does not fit, or a position is not finite
    SurfaceMeter(std::shared_ptr<const Topology> topology,
                 std::shared_ptr<const Positions> original, bool planes = false,
                 std::span<const VertexId> order = {});
    ~SurfaceMeter();
    SurfaceMeter(const SurfaceMeter&) = delete;
    SurfaceMeter& operator=(const SurfaceMeter&) = delete;

    /// Every place as its own reference.
    [[nodiscard]] std::vector<VertexId> own_references() const;

    /// Moves the reference neighbourhoods along with a state's vertices (6.4.1).
    void follow(Packs moved, std::vector<VertexId>& references) const;

    /// Updates the references to this state, and measures it.
    [[nodiscard]] QualityMeasures follow_and_measure(Packs moved,
                                                     std::vector<VertexId>& references) const;

    /// The same, for states between those at which the references are updated.
    [[nodiscard]] QualityMeasures measure(Packs moved,
                                          const std::vector<VertexId>& references) const;

    /// The same from every 32nd place, tracked alone; the volume is exact. Curvature is scaled by
    /// the area that the sample represents. All states err in the same way, by a few per cent with
    /// some thousand vertices: enough to compare sets before the best ones are measured.
    [[nodiscard]] QualityMeasures follow_and_estimate(Packs moved,
                                                      std::vector<VertexId>& references) const;

    /// The errors of all places from references followed from the places themselves, whatever was
    /// measured before.
    [[nodiscard]] SeenMeasures measure_seen(Packs moved) const;

    [[nodiscard]] const QualityMeasures& original() const { return original_; }

    [[nodiscard]] double mean_edge() const { return mean_edge_; }  ///< of the original [mm]

private:
    struct Data;
    QualityMeasures measured(Packs moved, const VertexId* references, VertexId* followed) const;
    [[nodiscard]] QualityMeasures sampled(Packs moved, VertexId* references) const;

    std::unique_ptr<const Data> data_;
    QualityMeasures original_;
    double sample_scale_ = 1.0;  ///< the original's area relative to that around the sample
    double mean_edge_ = 0.0;
};

}  // namespace vesselbench
