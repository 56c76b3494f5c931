#pragma once

#include <functional>
#include <string>

#include "meshing/products/cfd_parameters.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench::test {

/// A case of a mesh as an export writes it.
void write_case(const std::string& folder, const VolumeMesh& mesh,
                const CfdParameters& parameters = {});

/// What a solver is made to have found.
struct PlantedFlow {
    int iterations = 60;
    /// OpenFOAM's field at a place [mm] of the wall [m^2/s^2]
    std::function<Vec3(const Vec3&)> wall_shear = [](const Vec3&) { return Vec3::Zero(); };
    double pressure = 0.25;  ///< at the inlet [m^2/s^2]; 0 at the outlet
    double inflow = 1.2e-6;  ///< [m^3/s]
    double outflow = 1.2e-6;
    /// Of every equation, by iteration.
    std::function<double(int)> residual = [](int) { return 1e-4; };
};

/// Fields and tables as simpleFoam writes them, without a solver, into a case with the patches
/// wall, inlet and outlet_1.
void plant_flow(const std::string& folder, const VolumeMesh& mesh, const PlantedFlow& flow);

}  // namespace vesselbench::test
