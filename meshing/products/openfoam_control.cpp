#include "meshing/products/openfoam_control.h"

#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

/// At most, between two time folders, of which the last two are kept: what a killed run loses.
constexpr int kIterationsBetweenWrites = 50;

constexpr const char* kWholeControl = R"(application     simpleFoam;
startFrom       latestTime;
startTime       0;
stopAt          endTime;
deltaT          1;
writeControl    timeStep;
purgeWrite      2;
writeFormat     ascii;
writePrecision  8;
timeFormat      general;
timePrecision   6;
runTimeModifiable false;
)";

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
    // The last iteration is one that is written: OpenFOAM ends without writing.
    const int writes =
        (parameters.iterations + kIterationsBetweenWrites - 1) / kIterationsBetweenWrites;
    const int interval = parameters.iterations / writes;
    TextBuffer out;
    out << foam_header("dictionary", "system", "controlDict") << kWholeControl << "endTime         "
        << interval * writes
        << ";  // most iterations; system/fvSolution ends the run at its residuals\n"
        << "writeInterval   " << interval << ";\n\nfunctions\n{\n"
        << "    wallShearStress  // kinematic [m^2/s^2]; times " << parameters.density
        << " for Pa\n    {\n        type            wallShearStress;\n"
        << "        libs            (\"libfieldFunctionObjects.so\");\n"
        << "        writeControl    writeTime;\n        log             false;\n    }\n"
        << kUsualFunctions;
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
