#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "workbench/window/model/latest_task.h"

namespace vesselbench {

/// Where a vessel is to be cut, as a form gives it.
struct CutQuestion {
    std::optional<Vec3> tip;         ///< of the branch [mm]; none: the plane's tip
    std::optional<double> distance;  ///< from the tip [mm]; none: chosen by the operation
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

/// Finds the cut where the operation would make it.
/// \param known the branch of an earlier cut, used again if it is of the same surface and tip
/// \throw Cancelled
[[nodiscard]] Cut find_cut(const Surface& surface, const CutQuestion& question,
                           const std::shared_ptr<const CutBranch>& known,
                           const Progress& progress = {});

/// Finds cuts on a thread of its own while a plane is dragged.
class CutSearch {
public:
    /// \param wake called by the other thread when update() has something to do
    explicit CutSearch(std::function<void()> wake) : task_(std::move(wake)) {}

    /// Once a frame: begins a search if the question or the surface is another one, and takes a
    /// result. The last cut of the same branch stays until the next one is known.
    /// \param surface null: there is nothing to cut
    void update(const Surface* surface, const std::optional<CutQuestion>& question);

    [[nodiscard]] const std::optional<Cut>& cut() const { return cut_; }

    [[nodiscard]] bool pending() const { return task_.pending(); }

private:
    std::optional<CutQuestion> asked_;
    Surface surface_;  ///< of the question
    std::optional<Cut> cut_;
    LatestTask<Cut> task_;
};

}  // namespace vesselbench
