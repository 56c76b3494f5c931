#include "workbench/export/flow_parameters.h"

namespace vesselbench {

std::vector<Parameter> flow_parameters() {
    using enum ParameterType;
    const CfdParameters d;
    return {{.name = "flow",
             .unit = "cm^3/s",
             .default_value = d.flow,
             .help = "total inflow of blood through all inlets; distributed by their areas",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "profile",
             .type = Choice,
             .default_value = "parabolic",
             .help = "velocity profile at the inlet: parabolic, as in a long straight vessel with "
                     "the inlet's shape, or plug, the same everywhere",
             .choices = {"parabolic", "plug"}},
            {.name = "density",
             .unit = "kg/m^3",
             .default_value = d.density,
             .help = "of blood",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "viscosity",
             .unit = "Pa s",
             .default_value = d.viscosity,
             .help = "dynamic viscosity of blood, constant for all shear rates",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "iterations",
             .type = Integer,
             .default_value = std::int64_t{d.iterations},
             .help = "largest number of iterations of simpleFoam; it stops earlier at the residual",
             .minimum = 1,
             .maximum = 1000000},
            {.name = "residual",
             .unit = "-",
             .default_value = d.residual,
             .help = "initial residuals of pressure and velocity at which the run stops",
             .minimum = 0.0,
             .maximum = 1.0,
             .above_minimum = true},
            {.name = "processes",
             .type = Integer,
             .default_value = std::int64_t{d.processes},
             .help = "number of parts made by decomposePar for mpirun",
             .minimum = 1,
             .maximum = 1024}};
}

CfdParameters flow_from(const Arguments& arguments) {
    CfdParameters flow;
    const auto take = [&](const char* name, double& field) {
        if (arguments.has(name)) field = arguments.real(name);
    };
    take("flow", flow.flow);
    take("density", flow.density);
    take("viscosity", flow.viscosity);
    take("residual", flow.residual);
    if (arguments.has("profile"))
        flow.profile =
            arguments.text("profile") == "plug" ? InflowProfile::Plug : InflowProfile::Parabolic;
    if (arguments.has("iterations"))
        flow.iterations = static_cast<int>(arguments.integer("iterations"));
    if (arguments.has("processes"))
        flow.processes = static_cast<int>(arguments.integer("processes"));
    return flow;
}

}  // namespace vesselbench
