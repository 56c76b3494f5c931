#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/progress.h"
#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// The centerlines on which an opening is planned: those of all vessel ends; if none of them is at
/// the tip, those to the tip.
/// \param tip of the one branch to open [mm]; none: all vessel ends
/// \throw what centerlines_of throws
[[nodiscard]] std::shared_ptr<const CenterlineGraph> lines_for_openings(
    const Surface& surface, const std::optional<Vec3>& tip, const Progress& progress = {});

/// Where a vessel is to be cut.
struct CutQuestion {
    std::optional<Vec3> tip;         ///< of the branch [mm]; none: the plane's tip
    std::optional<double> distance;  ///< from the tip [mm]; none: chosen by plan_openings
    std::optional<double> radii;     ///< the same in radii of the tip's vessel
    std::optional<Plane> plane;      ///< given: used as it is

    bool operator==(const CutQuestion& other) const;
};

/// A branch that can be cut.
struct CutBranch {
    Surface surface;  ///< whole
    Surface part;     ///< near the tip, on which measuring is fast
    std::shared_ptr<const CenterlineGraph> graph;
    std::size_t tip = 0;  ///< node of the graph
    Vec3 asked = Vec3::Zero();
    double radius = 0.0;         ///< of the vessel at its tip [mm]
    Positions track;             ///< the centerline from the tip inward [mm]
    double length = 0.0;         ///< of the track [mm]
    std::optional<Patch> patch;  ///< that closes the vessel now

    /// The centerline's point at a distance from the tip [mm].
    [[nodiscard]] Vec3 place(double distance) const;

    /// Unit, out of the vessel, at a distance from the tip.
    [[nodiscard]] Vec3 outward(double distance) const;

    /// Distance from the tip of the track's point that is closest to a point [mm].
    [[nodiscard]] double distance_of(const Vec3& point) const;
};

/// A cut through a vessel.
struct Cut {
    std::shared_ptr<const CutBranch> branch;  ///< null: there is none; `problem` says why
    Plane plane;                              ///< normal out of the vessel
    double distance = 0.0;                    ///< from the tip along the centerline [mm]
    double tilt_deg = 0.0;                    ///< between the normal and the centerline
    Positions ring;                           ///< the section [mm]; empty: there is none
    double area = 0.0;                        ///< [mm^2]
    double diameter = 0.0;                    ///< of the circle of this area [mm]
    std::string problem;                      ///< why there is no cut; empty: there is one
};

/// Finds the cut that plan_openings would plan; quick enough to follow a plane that is dragged.
/// \param known the branch of an earlier cut, used again if it is of the same surface and tip
/// \throw Cancelled
[[nodiscard]] Cut find_cut(const Surface& surface, const CutQuestion& question,
                           const std::shared_ptr<const CutBranch>& known,
                           const Progress& progress = {});

}  // namespace vesselbench
