#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/opening_place.h"

namespace vesselbench {

/// Judges cuts before they are made: what each would remove, and whether it gets in the way of
/// another one. Not thread-safe.
class CutTrials {
public:
    /// \param courses diameters of the ends' vessels along their courses [mm], #ends; 0: unknown
    CutTrials(const Surface& surface, const CenterlineGraph& graph,
              const std::vector<SurfaceEnd>& ends, std::vector<double> courses);

    /// Why an end cannot be cut at a place; empty if it can. A cut must not remove another end,
    /// except the short tips and narrow rims that a ragged end has; nor vessels beside its own
    /// branch; nor open a vessel's side.
    [[nodiscard]] std::string problem_of(const OpeningPlace& place, std::size_t end);

    /// The ends whose tips the cut of the last problem_of removes, too.
    [[nodiscard]] const std::vector<std::size_t>& taken_along() const { return taken_along_; }

    /// Keeps other cuts away from the one of the last problem_of.
    void take();

    /// True if no cut that was taken reaches an end's cap.
    [[nodiscard]] bool is_whole_cap(const SurfaceEnd& end) const;

    /// Keeps cuts away from an end's rim or cap.
    void protect(const SurfaceEnd& end);

private:
    enum class Use : std::uint8_t { Free, Guarded, Gone };

    [[nodiscard]] std::string shape_problem(const SectionCurve& curve,
                                            const OpeningPlace& place) const;
    [[nodiscard]] std::string width_problem(const OpeningPlace& place, std::size_t end) const;
    [[nodiscard]] std::string flood(const SectionCurve& curve);
    [[nodiscard]] std::string lost_problem(const OpeningPlace& place, std::size_t end);
    [[nodiscard]] bool is_own_rim(const OpeningPlace& place, std::size_t end,
                                  std::size_t other) const;
    [[nodiscard]] bool is_thread(const OpeningPlace& place, std::size_t end,
                                 std::size_t other) const;
    [[nodiscard]] bool is_ragged_tip(const OpeningPlace& place, std::size_t other) const;

    const Surface& surface_;
    const CenterlineGraph& graph_;
    const std::vector<SurfaceEnd>& ends_;
    std::vector<double> courses_;
    std::vector<Use> use_;             ///< #V
    std::vector<std::uint32_t> seen_;  ///< #V: the last trial that reached the vertex
    std::uint32_t trial_ = 0;
    std::vector<VertexId> strip_, removed_;  ///< of the last trial
    std::vector<std::size_t> taken_along_;
};

}  // namespace vesselbench
