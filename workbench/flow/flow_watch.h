#pragma once

#include "workbench/flow/flow_tables.h"

namespace vesselbench {

/// When a run may end: its figures rest, and its equations are solved well enough for that.
struct SettlingLimits {
    int window = 50;          ///< iterations over which figures must rest
    double change = 0.002;    ///< of a figure over the window, relative [-]
    double residual = 0.001;  ///< initial residual of every equation [-]
};

/// How near a run is to its end.
struct Settling {
    double change = 1.0;    ///< largest relative change of a figure over the window [-]
    double residual = 1.0;  ///< largest initial residual in the last iteration [-]
    bool settled = false;
    double remaining = 0.0;  ///< iterations that are left, by how both fell so far; an estimate
};

/// Pressures change relative to the largest difference between openings, flows relative to the
/// inflow, the mean wall shear stress relative to itself.
[[nodiscard]] Settling settling_of(const FlowHistory& history, const FlowRecord& record,
                                   const SettlingLimits& limits = {});

/// The last value of a series; of a pulsatile flow, the mean over the last period's steps.
/// \param series not empty
[[nodiscard]] double counted_value(const FlowSeries& series, const FlowRecord& record);

/// Largest difference of pressure between an inlet and an outlet (counted_value) [Pa]; 0: there is
/// none yet.
[[nodiscard]] double pressure_drop(const FlowHistory& history, const FlowRecord& record);

/// What enters through inlets (counted_value) [cm^3/s].
[[nodiscard]] double total_inflow(const FlowHistory& history, const FlowRecord& record);

}  // namespace vesselbench
