#pragma once

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Figures of one place of the wall over a period.
struct CycleShear {
    double tawss = 0.0;  ///< time-averaged magnitude of the wall shear stress [Pa]
    double osi = 0.0;    ///< oscillatory shear index, 0: one direction, 0.5: no mean [-]
    double rrt = 0.0;    ///< relative residence time [1/Pa]; infinite where osi is 0.5
    double ecap = 0.0;   ///< endothelial cell activation potential [1/Pa]
};

/// OSI = 0.5 (1 - |mean vector| / TAWSS): He, Ku, "Pulsatile flow in the human left coronary artery
/// bifurcation: average conditions", J Biomech Eng 118, 1996. RRT = 1 / ((1 - 2 OSI) TAWSS):
/// Himburg et al., "Spatial comparison between wall shear stress measures and porcine arterial
/// endothelial permeability", Am J Physiol 286, 2004. ECAP = OSI / TAWSS: Di Achille et al., "A
/// haemodynamic predictor of intraluminal thrombus formation in abdominal aortic aneurysms", Proc R
/// Soc A 470, 2014.
/// Without any shear, the first two and the last are 0.
/// \param mean wall shear stress vector, averaged over the period [Pa]
/// \param tawss its magnitude, averaged over the period [Pa]
[[nodiscard]] CycleShear cycle_shear(const Vec3& mean, double tawss);

}  // namespace vesselbench
