#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/surface.h"
#include "meshing/products/waveform.h"

namespace vesselbench {

enum class InflowProfile { Plug, Parabolic };

/// How several inlets share the flow.
enum class FlowSplit {
    Area,   ///< all with the same mean velocity
    Cubes,  ///< by the cubes of the diameters: the same shear in all branches (Murray, "The
            ///< physiological principle of minimum work", 1926)
};

/// What leaves through the outlets.
enum class OutletFlow {
    ZeroPressure,  ///< what the resistance of the model's vessels makes of one pressure at all
    Area,          ///< by their areas: all with the same mean velocity
    Cubes,         ///< by the cubes of their diameters (Murray 1926)
    Bifurcations   ///< by the diameters of the vessels behind each bifurcation on the way
};

/// How the viscosity of blood depends on the shear rate.
enum class ViscosityModel { Newtonian, Carreau };

/// mu = mu_inf + (mu_0 - mu_inf) (1 + (lambda rate)^2)^((n - 1) / 2). Source of the constants: Cho,
/// Kensey, "Effects of the non-Newtonian viscosity of blood on flows in a diseased arterial
/// vessel", Biorheology 28, 1991.
namespace carreau {
inline constexpr double kAtRest = 0.056;     ///< mu_0 [Pa s]
inline constexpr double kAtShear = 0.00345;  ///< mu_inf [Pa s]
inline constexpr double kTime = 3.313;       ///< lambda [s]
inline constexpr double kExponent = 0.3568;  ///< n [-]
}  // namespace carreau

/// The flow through one inlet.
struct NamedFlow {
    std::string inlet;
    double flow = 0.0;  ///< [cm^3/s], > 0
};

/// Flow of blood through a model with rigid walls: laminar; steady (thesis 5.5.1), or pulsatile.
struct CfdParameters {
    double density = 1000.0;  ///< [kg/m^3], > 0
    double viscosity = 4e-3;  ///< dynamic, of Newtonian blood [Pa s], > 0
    ViscosityModel viscosity_model = ViscosityModel::Newtonian;
    double flow = 1.2;  ///< through all inlets together [cm^3/s], > 0; distributed by `split`
    std::optional<FlowSplit> split = std::nullopt;  ///< none: Area
    std::vector<NamedFlow> inlet_flows = {};  ///< in place of it, one for every inlet; or none
    OutletFlow outlets = OutletFlow::ZeroPressure;
    double outlet_exponent = 2.0;  ///< of the diameters at bifurcations [-], >= 0; 3: Murray
    /// What OutletFlow::Bifurcations gives each outlet, by name [-]; empty: not found yet.
    std::map<std::string, double> outlet_shares = {};
    InflowProfile profile = InflowProfile::Parabolic;  ///< Parabolic: as in a long straight duct
    int iterations = 2000;                             ///< largest number of SIMPLE iterations
    double residual = 1e-5;  ///< initial residuals of p and U at which the run stops [-]
    int processes = 2;       ///< parts made by decomposePar
    /// Of the flow through all inlets together; none: it is steady. Its mean is `flow`.
    std::optional<Waveform> waveform = std::nullopt;
    int periods = 2;   ///< of the waveform that are computed; the last one counts
    int steps = 1000;  ///< of time in a period
};

/// One inlet under the given flow.
struct InletFlow {
    std::string name;
    double area = 0.0;           ///< [mm^2]
    double diameter = 0.0;       ///< hydraulic, 4 area / rim length [mm]
    double flow = 0.0;           ///< [cm^3/s]
    double mean_velocity = 0.0;  ///< [m/s]
    double reynolds = 0.0;       ///< mean velocity * diameter * density / viscosity [-]
};

/// One outlet whose flow is given.
struct GivenOutflow {
    std::string name;
    double flow = 0.0;  ///< [cm^3/s]
};

struct FlowSummary {
    std::vector<InletFlow> inlets;
    std::size_t outlets = 0;
    /// All outlets but the largest, through which the rest leaves; none for
    /// OutletFlow::ZeroPressure, and for Bifurcations without `outlet_shares`.
    std::vector<GivenOutflow> outflows = {};
    std::vector<Diagnostic> warnings;  ///< not laminar; inlet in a bend
};

/// Above this the flow in a straight pipe may become turbulent (Reynolds 1883: 2000-2300).
inline constexpr double kLaminarReynolds = 2000.0;
/// A centerline that turns more than this within two diameters of the inlet disturbs the profile.
inline constexpr double kLargestInletBend = 15.0;  // [deg]

/// Dynamic viscosity for Reynolds numbers: of Carreau's model that of high shear rates [Pa s].
[[nodiscard]] double viscosity_at_shear(const CfdParameters& parameters);

/// How flows of outlets are given: "by their areas"; empty for OutletFlow::ZeroPressure.
[[nodiscard]] std::string outlets_text(const CfdParameters& parameters);

/// simpleFoam of a steady flow, pimpleFoam of a pulsatile one.
[[nodiscard]] std::string solver_name(bool pulsatile);

/// The outlet through which the rest leaves where flows of outlets are given, in texts.
[[nodiscard]] std::string rest_outlet_text();

/// The flow that the parameters imply on this surface.
/// \param bends by inlet, turn of the centerline within two diameters [deg]; missing: unknown
/// \throw AlgorithmFailure if there is no inlet or no outlet; InvalidInput if a parameter is out of
/// range, or `inlet_flows` does not name every inlet once
[[nodiscard]] FlowSummary flow_summary(const Surface& surface, const CfdParameters& parameters,
                                       const std::map<std::string, double>& bends = {});

}  // namespace vesselbench
