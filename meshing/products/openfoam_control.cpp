#include "meshing/products/openfoam_control.h"

#include <algorithm>

#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

/// At most, between two time folders, of which the last two are kept: what a killed run loses.
constexpr int kIterationsBetweenWrites = 50;

/// Of a pulsatile flow, at least so many in a period.
constexpr int kWritesInPeriod = 20;

constexpr const char* kWholeControl = R"(startFrom       latestTime;
startTime       0;
stopAt          endTime;
writeControl    timeStep;
purgeWrite      2;
writeFormat     ascii;
writePrecision  8;
timeFormat      general;
runTimeModifiable false;
)";

/// The last step is one that is written: OpenFOAM ends without writing.
struct TimeControl {
    double step = 1.0;  ///< [s]; of a steady flow an iteration
    int steps = 0;
    int interval = 0;  ///< steps between two writes
};

TimeControl time_control(const CfdParameters& parameters) {
    if (!parameters.waveform) {
        const int writes =
            (parameters.iterations + kIterationsBetweenWrites - 1) / kIterationsBetweenWrites;
        const int interval = parameters.iterations / writes;
        return {.steps = interval * writes, .interval = interval};
    }
    int interval = std::max(1, parameters.steps / kWritesInPeriod);
    while (parameters.steps % interval != 0) --interval;
    return {.step = parameters.waveform->period() / parameters.steps,
            .steps = parameters.steps * parameters.periods,
            .interval = interval};
}

/// Begins within the step before the last period, so that exactly its steps count.
void put_cycle_means(TextBuffer& out, const CfdParameters& parameters, double step) {
    const double begin = parameters.waveform->period() * (parameters.periods - 1) + 0.5 * step;
    out << "    lastPeriod\n    {\n        type            fieldAverage;\n"
           "        libs            (\"libfieldFunctionObjects.so\");\n        timeStart       "
        << begin
        << ";\n        writeControl    writeTime;\n        restartOnRestart false;\n"
           "        log             false;\n        fields\n        (\n";
    for (const char* field : {"wallShearStress", "wallShearStressMagnitude", "p"})
        out << "            " << field << " { mean on; prime2Mean off; base time; }\n";
    out << "        );\n    }\n";
}

// mag() of the shear stress, since the mean of a vector over a wall cancels.
constexpr const char* kUsualFunctions = R"(    wallShearStressMagnitude
    {
        type            mag;
        libs            ("libfieldFunctionObjects.so");
        field           wallShearStress;
        result          wallShearStressMagnitude;
        writeControl    none;
        log             false;
    }
    residuals
    {
        type            solverInfo;
        libs            ("libutilityFunctionObjects.so");
        fields          (U p);
        log             false;
    }
    stop  // ends the run when a file of this name is there
    {
        type            abort;
        libs            ("libutilityFunctionObjects.so");
        action          writeNow;
    }
)";

void put_table(TextBuffer& out, const char* prefix, const std::string& patch, const char* operation,
               const char* field) {
    out << "    " << prefix << patch
        << "\n    {\n        type            surfaceFieldValue;\n"
           "        libs            (\"libfieldFunctionObjects.so\");\n"
           "        regionType      patch;\n        name            "
        << patch << ";\n        operation       " << operation << ";\n        fields          ("
        << field
        << ");\n        writeFields     false;\n        writeControl    timeStep;\n"
           "        writeInterval   1;\n        log             false;\n    }\n";
}

}  // namespace

std::string control_dictionary(std::span<const FoamPatch> patches,
                               const CfdParameters& parameters) {
    const bool pulsatile = parameters.waveform.has_value();
    const TimeControl time = time_control(parameters);
    TextBuffer out;
    out << foam_header("dictionary", "system", "controlDict") << "application     "
        << solver_name(pulsatile) << ";\n"
        << kWholeControl << "timePrecision   " << (pulsatile ? 9 : 6) << ";\ndeltaT          "
        << time.step << ";\nendTime         " << time.step * time.steps
        << (pulsatile ? ";  // the waveform's periods\n"
                      : ";  // most iterations; system/fvSolution ends the run at its residuals\n")
        << "writeInterval   " << time.interval << ";\n\nfunctions\n{\n"
        << "    wallShearStress  // kinematic [m^2/s^2]; times " << parameters.density
        << " for Pa\n    {\n        type            wallShearStress;\n"
        << "        libs            (\"libfieldFunctionObjects.so\");\n"
        << "        writeControl    writeTime;\n        log             false;\n    }\n"
        << kUsualFunctions;
    if (pulsatile) put_cycle_means(out, parameters, time.step);
    for (const FoamPatch& patch : patches) {
        if (patch.kind == PatchKind::Wall) {
            put_table(out, watched_tables::kWallShear, patch.name, "areaAverage",
                      "wallShearStressMagnitude");
        } else if (patch.kind != PatchKind::Cut) {
            put_table(out, watched_tables::kPressure, patch.name, "areaAverage", "p");
            put_table(out, watched_tables::kFlow, patch.name, "sum", "phi");
        }
    }
    out << "}\n";
    return out.text();
}

std::string decomposition_dictionary(const Bounds& bounds, int processes) {
    Eigen::Index longest = 0;
    (bounds.max - bounds.min).maxCoeff(&longest);
    TextBuffer out;
    out << foam_header("dictionary", "system", "decomposeParDict")
        << "// simple: Debian's scotch is a stub; slices along the longest "
           "axis\nnumberOfSubdomains "
        << processes << ";\n\nmethod          simple;\n\ncoeffs\n{\n    n           (";
    for (int k = 0; k < 3; ++k) out << (k > 0 ? " " : "") << (k == longest ? processes : 1);
    out << ");\n    delta       0.001;\n}\n";
    return out.text();
}

}  // namespace vesselbench
