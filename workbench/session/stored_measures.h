#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"
#include "workbench/case/history.h"

namespace vesselbench {

enum class MeasureKind {
    Distance,  ///< along points
    Diameter   ///< of a vessel
};

/// What was clicked.
enum class MeasuredOn { Surface, Preview, AxialSlice, CoronalSlice, SagittalSlice };

/// A measure that a user has made and wants to keep.
struct KeptMeasure {
    std::string name;
    MeasureKind kind = MeasureKind::Distance;
    /// A distance's, 2 or more, in the order of the clicks; a diameter's place on the centerline,
    /// followed by the outline of the section there, if there is one [mm].
    std::vector<Vec3> points;
    double length = 0.0;      ///< along the points; of a diameter: that of the largest sphere [mm]
    double area = 0.0;        ///< of a diameter's section [mm^2]; 0: there is none
    double equivalent = 0.0;  ///< diameter of the circle of that area [mm]
    MeasuredOn on = MeasuredOn::Surface;
    StateId state = 0;    ///< that was current
    std::string variant;  ///< that was shown
    std::string time;     ///< UTC, 2024-05-17T09:30:00Z

    bool operator==(const KeptMeasure&) const = default;
};

[[nodiscard]] std::string to_string(MeasureKind kind);  ///< "distance"
[[nodiscard]] std::string to_string(MeasuredOn on);     ///< "axial-slice"

/// Keeps measures in a project file, which a session of this process may have open. They replace
/// those kept so far; they are of the project, not of a state: undo does not change them.
/// \throw IoError if the project cannot be written
void store_measures(const std::filesystem::path& project, const std::vector<KeptMeasure>& measures);

/// The measures in a project file; none if it has none.
/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] std::vector<KeptMeasure> stored_measures(const std::filesystem::path& project);

}  // namespace vesselbench
