#pragma once

namespace vesselbench {

/// Parameters of the cap detection (thesis 5.3.4).
struct CapParameters {
    double flat_angle_deg = 5.0;  ///< largest angle of vertex and face normals in a flat area [deg]
    int smallest_faces = 10;      ///< flat areas of fewer faces are no caps
};

}  // namespace vesselbench
