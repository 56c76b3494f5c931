#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "workbench/flow/cycle_shear.h"
#include "workbench/flow/flow_case.h"
#include "workbench/flow/flow_tables.h"
#include "workbench/flow/flow_watch.h"

namespace vesselbench {

/// The wall of a solved case with what the blood does to it.
struct FlowWall {
    Surface surface;  ///< [mm], triangles outward
    /// Stress that the blood exerts on the wall; of a pulsatile flow its mean over the last period,
    /// as pressure; #T [Pa]
    std::vector<Vec3> shear;
    std::vector<double> magnitude;  ///< of the stress, or the mean of its magnitude, #T [Pa]
    std::vector<CycleShear> cycle;  ///< of a pulsatile flow, #T; empty: it is steady
    std::vector<double> pressure;   ///< static, relative to the outlets', #T [Pa]
    std::vector<double> areas;      ///< #T [mm^2]
    std::vector<double> own_areas;  ///< the same; 0 where the wall is not the vessel's own [mm^2]
};

/// Magnitudes of the wall shear stress over a region, weighted by area [Pa].
struct ShearFigures {
    double area = 0.0;  ///< [mm^2]
    double mean = 0.0, median = 0.0, p1 = 0.0, p5 = 0.0, p95 = 0.0, p99 = 0.0, largest = 0.0;
    double low_area = 0.0;  ///< where it is below kLowShear [mm^2]
};

/// Low wall shear stress [Pa]. Source: Malek, Alper, Izumo, "Hemodynamic shear stress and its role
/// in atherosclerosis", JAMA 282, 1999: below 4 dyn/cm^2 endothelium is prone to atherosclerosis.
inline constexpr double kLowShear = 0.4;

/// The same of a region of a sac's vessel.
struct RegionShear {
    std::string region;  ///< "sac", "parent", "daughters"
    ShearFigures shear;
};

struct OpeningFigures {
    RecordedOpening recorded;
    double flow = 0.0;  ///< in its own direction: in through an inlet, out of an outlet [cm^3/s]
    double pressure = 0.0;  ///< static, mean over its area [Pa]
};

/// Figures of the wall in a pulsatile flow, weighted by area over the vessel's own wall.
struct CycleFigures {
    double osi_mean = 0.0, osi_p95 = 0.0;      ///< [-]
    double rrt_median = 0.0, rrt_p95 = 0.0;    ///< [1/Pa]
    double ecap_median = 0.0, ecap_p95 = 0.0;  ///< [1/Pa]
};

/// The figures of a solved flow; of a pulsatile one, means over its last period.
struct FlowResults {
    FlowCase flow;
    double time = 0.0;  ///< iterations of the solver until the fields were written
    FlowHistory history;
    Settling settling;
    bool converged = false;  ///< by figures or residuals
    std::string solver;      ///< "OpenFOAM 1912"; "OpenFOAM" where its log is missing
    FlowWall wall;
    ShearFigures shear;  ///< of the vessel's own wall: without what was cut and extended
    std::optional<CycleFigures> cycle = std::nullopt;  ///< of a pulsatile flow
    /// Of the wall's mean shear, from the period before the last to the last one, relative; none:
    /// there is one period, or the flow is steady.
    std::optional<double> period_change = std::nullopt;
    std::vector<RegionShear> regions;  ///< with a wall, where a sac's neck was marked
    std::vector<OpeningFigures> openings;
    double pressure_drop = 0.0;  ///< [Pa]
    double imbalance = 0.0;      ///< what flows in and not out, as a fraction of the inflow [-]
};

/// Magnitudes of vectors.
[[nodiscard]] std::vector<double> magnitudes(const std::vector<Vec3>& vectors);

/// \param areas of the places of the values, at least one above 0
[[nodiscard]] ShearFigures shear_figures(const std::vector<double>& values,
                                         const std::vector<double>& areas);

/// \param areas of the places of the values, at least one above 0
[[nodiscard]] CycleFigures cycle_figures(const std::vector<CycleShear>& values,
                                         const std::vector<double>& areas);

/// Reads the last time of a case that was written whole. OpenFOAM's shear stress is by density, and
/// has the direction of the wall's force on the blood: both are turned here.
/// \throw InvalidInput if it has not been run, if fields are missing or of another mesh, or if the
/// surface of the preparation that it is in is of another mesh
[[nodiscard]] FlowResults read_flow_results(const FlowCase& flow);

}  // namespace vesselbench
