#include "meshing/products/openfoam_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "geometry/formats/comment_line.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/inflow.h"
#include "meshing/products/openfoam_control.h"
#include "meshing/products/openfoam_mesh.h"
#include "meshing/products/text_buffer.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

struct CaseWriter {
    const VolumeMesh& mesh;
    const CfdParameters& parameters;
    FlowSummary flow;
    std::vector<MeshFace> faces;
    std::vector<FoamPatch> patches;

    [[nodiscard]] std::span<const MeshFace> faces_of(const FoamPatch& patch) const {
        return std::span(faces).subspan(patch.first_face, patch.faces);
    }

    [[nodiscard]] Vec3 area_vector(const FoamPatch& patch) const {  // outward [mm^2]
        Vec3 sum = Vec3::Zero();
        for (const MeshFace& face : faces_of(patch))
            sum += 0.5 * face_normal(mesh.points, face.corners);
        return sum;
    }

    [[nodiscard]] double flow_through(const FoamPatch& inlet) const {  // [cm^3/s]
        return std::ranges::find(flow.inlets, inlet.name, &InletFlow::name)->flow;
    }

    /// The flow that is given for an outlet [cm^3/s]; none: what the pressures make of it.
    [[nodiscard]] std::optional<double> given_outflow(const FoamPatch& patch) const {
        const auto& all = flow.outflows;
        const auto found =
            std::ranges::find(all, mesh.patches[patch.index].name, &GivenOutflow::name);
        return found == all.end() ? std::nullopt : std::optional(found->flow);
    }

    [[nodiscard]] std::string flows() const {  // for comments
        std::vector<std::string> texts;
        const std::string unit = parameters.waveform ? " cm^3/s in the mean" : " cm^3/s";
        for (const InletFlow& inlet : flow.inlets)
            texts.push_back(inlet.name + " carries " + formatted(inlet.flow, "%g") + unit);
        if (parameters.waveform)
            texts.push_back((parameters.waveform->synthetic ? "synthetic waveform of"
                                                            : "waveform of a file of") +
                            formatted(parameters.waveform->period(), " %g s"));
        return joined(texts, ", ");
    }

    [[nodiscard]] bool resting(const FoamPatch& patch) const {
        return patch.kind == PatchKind::Wall || patch.kind == PatchKind::Cut;
    }

    /// Mean velocity of each face of an inlet [m/s].
    [[nodiscard]] std::vector<Vec3> inflow(const FoamPatch& inlet) const;
    void put_inflow(TextBuffer& out, const FoamPatch& inlet) const;
    void put_outflow(TextBuffer& out, double mean) const;
    /// The samples of all periods: times [s], with the flow relative to its mean [-].
    [[nodiscard]] std::vector<std::pair<double, double>> samples() const;
    void write_boundary_data(const fs::path& folder, const Progress& progress) const;
    [[nodiscard]] std::string velocity() const;
    [[nodiscard]] std::string pressure() const;
    [[nodiscard]] std::string transport() const;
};

// Of every face; a quadrilateral's is the mean over its two triangles, weighted by area.
std::vector<double> profile_of_faces(const Positions& points, std::span<const MeshFace> faces) {
    std::vector<Triangle> triangles;
    for (const MeshFace& face : faces)
        for (std::size_t k = 2; k < face.corners.size(); ++k)
            triangles.push_back({face.corners[0], face.corners[k - 1], face.corners[k]});
    const std::vector<double> profile = developed_profile(points, triangles);
    std::vector<double> means;
    for (std::size_t t = 0; const MeshFace& face : faces) {
        if (face.corners.size() == 3) {
            means.push_back(profile[t++]);
            continue;
        }
        const double first = area_normal(points, triangles[t]).norm(),
                     second = area_normal(points, triangles[t + 1]).norm();
        means.push_back((first * profile[t] + second * profile[t + 1]) / (first + second));
        t += 2;
    }
    return means;
}

// Directed along the mean inward normal, with an exact mean velocity although a rim is never quite
// flat.
std::vector<Vec3> CaseWriter::inflow(const FoamPatch& inlet) const {
    const Vec3 inward = -area_vector(inlet).normalized();
    const std::span<const MeshFace> rows = faces_of(inlet);
    std::vector<double> profile(rows.size(), 1.0);
    if (parameters.profile == InflowProfile::Parabolic)
        profile = profile_of_faces(mesh.points, rows);
    double flux = 0.0;  // of the profile [mm^2]
    for (std::size_t f = 0; f < rows.size(); ++f)
        flux -= profile[f] * 0.5 * face_normal(mesh.points, rows[f].corners).dot(inward);
    const double scale = flow_through(inlet) / flux;  // [m/s]
    std::vector<Vec3> velocities;
    for (const double u : profile) velocities.emplace_back(u * scale * inward);
    return velocities;
}

void put_vectors(TextBuffer& out, const std::vector<Vec3>& vectors, double factor = 1.0) {
    out << vectors.size() << "\n(\n";
    for (const Vec3& v : vectors)
        out << '(' << factor * v.x() << ' ' << factor * v.y() << ' ' << factor * v.z() << ")\n";
    out << ")\n";
}

void CaseWriter::put_inflow(TextBuffer& out, const FoamPatch& inlet) const {
    if (parameters.waveform)
        out << "        type            timeVaryingMappedFixedValue;\n"
               "        mapMethod       nearest;\n        setAverage      false;\n"
               "        offset          (0 0 0);\n";
    else
        out << "        type            fixedValue;\n";
    out << "        value           nonuniform List<vector>\n";
    put_vectors(out, inflow(inlet), parameters.waveform ? samples().front().second : 1.0);
    out << ";\n";
}

void CaseWriter::put_outflow(TextBuffer& out, double mean) const {
    out << "        type            flowRateOutletVelocity;\n        volumetricFlowRate ";
    if (parameters.waveform) {
        out << "table\n        (\n";
        for (const auto& [time, factor] : samples())
            out << "            (" << time << ' ' << mean * factor * 1e-6 << ")\n";
        out << "        );\n";
    } else {
        out << "constant " << mean * 1e-6 << ";\n";
    }
    out << "        value           uniform (0 0 0);\n";
}

std::vector<std::pair<double, double>> CaseWriter::samples() const {
    const Waveform& wave = *parameters.waveform;
    const double mean = wave.mean();
    std::vector<std::pair<double, double>> rows;
    for (int period = 0; period < parameters.periods; ++period)
        for (std::size_t i = period == 0 ? 0 : 1; i < wave.times.size(); ++i)
            rows.emplace_back(period * wave.period() + wave.times[i], wave.flows[i] / mean);
    return rows;
}

// The solver is linear between the times of these files.
void CaseWriter::write_boundary_data(const fs::path& folder, const Progress& progress) const {
    for (const FoamPatch& patch : patches) {
        if (patch.kind != PatchKind::Inlet) continue;
        std::vector<Vec3> centres;
        for (const MeshFace& face : faces_of(patch)) {
            Vec3 sum = Vec3::Zero();
            for (const VertexId corner : face.corners) sum += mesh.points[corner];
            centres.emplace_back(1e-3 * sum / static_cast<double>(face.corners.size()));
        }
        const fs::path data = folder / "constant/boundaryData" / patch.name;
        make_folder(data);
        TextBuffer points;
        put_vectors(points, centres);
        write_file(data / "points", points.text());
        const std::vector<Vec3> velocities = inflow(patch);
        for (const auto& [time, factor] : samples()) {
            progress.check_cancelled();
            const fs::path sample = data / formatted(time, "%.9g");
            make_folder(sample);
            TextBuffer values;
            put_vectors(values, velocities, factor);
            write_file(sample / "U", values.text());
        }
    }
}

std::string CaseWriter::velocity() const {
    TextBuffer out;
    out << foam_header("volVectorField", "0", "U") << "// [m/s]; " << flows() << "; "
        << (parameters.profile == InflowProfile::Plug ? "the same velocity everywhere"
                                                      : "profile of the developed laminar flow")
        << "\ndimensions      [0 1 -1 0 0 0 0];\n\ninternalField   uniform (0 0 "
           "0);\n\nboundaryField\n{\n";
    for (const FoamPatch& patch : patches) {
        out << "    " << patch.name << "\n    {\n";
        if (resting(patch))
            out << "        type            noSlip;\n";
        else if (patch.kind == PatchKind::Inlet)
            put_inflow(out, patch);
        else if (const auto given = given_outflow(patch))
            put_outflow(out, *given);
        else
            out << "        type            inletOutlet;\n        inletValue      uniform (0 0 "
                   "0);\n        value           uniform (0 0 0);\n";
        out << "    }\n";
    }
    out << "}\n";
    return out.text();
}

std::string CaseWriter::pressure() const {
    TextBuffer out;
    out << foam_header("volScalarField", "0", "p")
        << "// kinematic: pressure by density [m^2/s^2]; times " << parameters.density
        << " for Pa\ndimensions      [0 2 -2 0 0 0 0];\n\ninternalField   uniform "
           "0;\n\nboundaryField\n{\n";
    for (const FoamPatch& patch : patches) {
        out << "    " << patch.name << "\n    {\n";
        if (patch.kind == PatchKind::Outlet && !given_outflow(patch))
            out << "        type            fixedValue;\n        value           uniform 0;\n";
        else
            out << "        type            zeroGradient;\n";
        out << "    }\n";
    }
    out << "}\n";
    return out.text();
}

std::string CaseWriter::transport() const {
    TextBuffer out;
    out << foam_header("dictionary", "constant", "transportProperties");
    if (parameters.viscosity_model == ViscosityModel::Newtonian)
        out << "// dynamic viscosity " << parameters.viscosity << " Pa s, density "
            << parameters.density
            << " kg/m^3\ntransportModel  Newtonian;\n\nnu              [0 2 -1 0 0 0 0] "
            << parameters.viscosity / parameters.density << ";\n";
    else
        out << "// Carreau: Cho, Kensey 1991; density " << parameters.density
            << " kg/m^3\ntransportModel  BirdCarreau;\n\nBirdCarreauCoeffs\n{\n"
               "    nu0             [0 2 -1 0 0 0 0] "
            << carreau::kAtRest / parameters.density << ";\n    nuInf           [0 2 -1 0 0 0 0] "
            << carreau::kAtShear / parameters.density << ";\n    k               [0 0 1 0 0 0 0] "
            << carreau::kTime << ";\n    n               [0 0 0 0 0 0 0] " << carreau::kExponent
            << ";\n}\n";
    return out.text();
}

std::string turbulence() {
    return foam_header("dictionary", "constant", "turbulenceProperties") +
           "simulationType  laminar;\n";
}

// Up to this angle [deg] the full non-orthogonal correction is stable, and one pressure solution
// per iteration suffices.
constexpr double kMildNonOrthogonality = 65.0;

std::string schemes(bool pulsatile, double largest_non_orthogonality) {
    const std::string correction =
        largest_non_orthogonality < kMildNonOrthogonality ? "corrected" : "limited corrected 0.5";
    return foam_header("dictionary", "system", "fvSchemes") +
           "ddtSchemes\n{\n    default         " + (pulsatile ? "Euler" : "steadyState") + R"(;
}

gradSchemes
{
    // exact for linear fields on tetrahedra; Gauss linear overestimates a tube's pressure drop by 10 %
    default         edgeCellsLeastSquares;
    grad(p)         pointCellsLeastSquares;
}

divSchemes
{
    default         none;
    div(phi,U)      )" +
           (pulsatile ? "" : "bounded ") + R"(Gauss linearUpwind grad(U);
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}

laplacianSchemes
{
    default         Gauss linear )" +
           correction + R"(;
}

interpolationSchemes
{
    default         linear;
}

snGradSchemes
{
    default         )" +
           correction + R"(;
}
)";
}

constexpr const char* kSolvers = R"(solvers
{
    p
    {
        solver          GAMG;
        smoother        GaussSeidel;
        tolerance       1e-8;
        relTol          0.05;
    }

    U
    {
        solver          smoothSolver;
        smoother        symGaussSeidel;
        tolerance       1e-9;
        relTol          0.1;
    }

    pFinal  // of a pulsatile flow
    {
        $p;
        relTol          0.005;
    }

    UFinal
    {
        $U;
        relTol          0;
    }
}

)";

/// Steps of time that pass several cells need SIMPLEC's corrections: PISO's two grow without bound
/// with the gradients of fvSchemes.
constexpr const char* kPimple = R"(PIMPLE
{
    consistent      yes;
    nOuterCorrectors 20;
    nCorrectors     1;

    residualControl
    {
        p { tolerance 1e-3; relTol 0; }
        U { tolerance 1e-3; relTol 0; }
    }

    nNonOrthogonalCorrectors )";

constexpr const char* kPimpleRelaxation = R"(
relaxationFactors
{
    equations
    {
        "U.*"           0.9;
    }
}
)";

std::string solution(const CfdParameters& parameters, double largest_non_orthogonality) {
    TextBuffer out;
    out << foam_header("dictionary", "system", "fvSolution") << kSolvers;
    const int corrections = largest_non_orthogonality < kMildNonOrthogonality ? 0 : 1;
    if (parameters.waveform) {
        out << kPimple << corrections << ";\n}\n" << kPimpleRelaxation;
        return out.text();
    }
    out << R"(SIMPLE
{
    consistent      yes;
    nNonOrthogonalCorrectors )"
        << corrections << R"(;

    residualControl
    {
        p               )"
        << parameters.residual << ";\n        U               " << parameters.residual << R"(;
    }
}

relaxationFactors
{
    equations
    {
        U               0.9;
    }
}
)";
    return out.text();
}

std::string script(bool pulsatile, bool parallel) {
    const std::string solver = solver_name(pulsatile);
    const std::string head = R"sh(#!/bin/sh
# Runs the case; results lie in the last time folder (metres, kinematic pressure) and in postProcessing/.
cd "$(dirname "$0")" || exit 1
if [ -z "$WM_PROJECT_DIR" ] && [ -d /usr/share/openfoam ]; then
    WM_PROJECT_DIR=/usr/share/openfoam
    export WM_PROJECT_DIR
fi
run() {  # run NAME COMMAND...: its output goes to log.NAME
    name=$1
    shift
    "$@" > "log.$name" 2>&1 && return
    tail -n 5 "log.$name" >&2
    echo "$name failed: see log.$name" >&2
    exit 1
}
)sh";
    const std::string verdict =
        R"sh(if converged=$(grep -i "solution converged" log.simpleFoam); then
    echo "$converged"
else
    echo "The flow has not converged: see log.simpleFoam; controlDict limits the iterations"
fi
)sh";
    const std::string end =
        (pulsatile ? "" : verdict) +
        R"sh(echo "Result: folder $(ls -d [0-9]* | sort -n | tail -n 1); ParaView opens case.foam"
touch case.foam
)sh";
    if (!parallel)
        return head + "run checkMesh checkMesh\nrun " + solver + " " + solver + "\n" + end;
    return head +
           R"sh(parts=$(sed -n 's/^numberOfSubdomains *\([0-9]*\);.*/\1/p' system/decomposeParDict)
run decomposePar decomposePar -force
run )sh" + solver +
           R"sh( mpirun -np "$parts" $MPIRUN_OPTIONS )sh" + solver + R"sh( -parallel
run reconstructPar reconstructPar -latestTime
)sh" + end;
}

std::string readme(const VolumeMesh& mesh, const CfdParameters& parameters,
                   const std::string& flows) {
    TextBuffer out;
    const std::string solver = solver_name(parameters.waveform.has_value());
    out << "OpenFOAM case of " << (parameters.waveform ? "pulsatile" : "steady")
        << " laminar blood flow, written by vesselbench.\n\n"
        << "  " << mesh.tetrahedra.size() << " tetrahedra";
    if (!mesh.prisms.empty()) out << " and " << mesh.prisms.size() << " prisms along the wall";
    out << "; lengths in metres; density " << parameters.density << " kg/m^3, viscosity "
        << viscosity_at_shear(parameters)
        << (parameters.viscosity_model == ViscosityModel::Carreau
                ? " Pa s at high shear rates (Carreau); "
                : " Pa s; ")
        << flows << "\n"
        << (parameters.outlets == OutletFlow::ZeroPressure
                ? std::string("  no-slip walls; outlets at pressure 0, backflow enters at rest\n\n")
                : "  no-slip walls; outlets with given flows, " + rest_outlet_text() +
                      " at pressure 0\n\n")
        << "  ./Allrun           checkMesh and " << solver << " on one core\n"
        << "  ./Allrun.parallel  decomposePar, mpirun -np " << parameters.processes << " " << solver
        << " -parallel, reconstructPar\n\n"
        << "Debian's OpenFOAM needs WM_PROJECT_DIR=/usr/share/openfoam; both scripts set it when "
           "it is missing. As root, set\n"
        << "MPIRUN_OPTIONS=\"--allow-run-as-root --oversubscribe\" before the second. Pressures "
           "are kinematic: multiply by the density.\n";
    return out.text();
}

void make_folders(const fs::path& folder) {
    std::error_code error;
    const bool something = fs::exists(folder, error) &&
                           !(fs::is_directory(folder, error) && fs::is_empty(folder, error));
    if (something && !fs::exists(folder / "system" / "controlDict", error))
        throw IoError("cannot write the OpenFOAM case: " + folder.filename().string() +
                      " exists and is not a case; give another folder");
    for (const char* part : {"0", "constant/polyMesh", "system"}) {
        fs::create_directories(folder / part, error);
        if (error)
            throw IoError("cannot create the folder " + folder.filename().string() + "/" + part +
                          ": " + error.message());
    }
}

void write_script(const fs::path& path, const std::string& text) {
    write_file(path, text);
    std::error_code ignored;
    fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                    fs::perm_options::add, ignored);
}

}  // namespace

bool is_unused_openfoam_case(const fs::path& folder) {
    constexpr std::array kOwn = {"0",      "constant",        "system", kFlowRecordFile,
                                 "Allrun", "Allrun.parallel", "README"};
    std::error_code error;
    if (!fs::is_regular_file(folder / "system" / "controlDict", error)) return false;
    fs::directory_iterator entries(folder, error);
    for (const fs::directory_iterator end; !error && entries != end; entries.increment(error))
        if (std::ranges::count(kOwn, entries->path().filename().string()) == 0) return false;
    return !error;
}

void write_openfoam_case(const fs::path& folder, const VolumeMesh& mesh,
                         const CfdParameters& parameters, const Progress& progress,
                         const std::string& provenance) {
    require_plain_names(mesh.patches);
    progress.report(0.0, writing_text(folder));
    FlowSummary flow = flow_summary(boundary_surface(mesh), parameters);
    const CellNeighbours neighbours = cell_neighbours(mesh, progress);
    progress.check_cancelled();
    CaseWriter writer{mesh, parameters, std::move(flow), mesh_faces(mesh, neighbours), {}};
    progress.check_cancelled();
    writer.patches = foam_patches(mesh, writer.faces);
    make_folders(folder);
    write_poly_mesh(folder / "constant/polyMesh", mesh, writer.faces, progress.part(0.1, 0.9));
    progress.report(0.9, writing_text(folder));
    write_file(folder / "0/U", writer.velocity());
    write_file(folder / "0/p", writer.pressure());
    write_file(folder / "constant/transportProperties", writer.transport());
    write_file(folder / "constant/turbulenceProperties", turbulence());
    progress.check_cancelled();
    const double angle = largest_non_orthogonality(mesh, writer.faces);
    progress.check_cancelled();
    const bool pulsatile = parameters.waveform.has_value();
    std::error_code ignored;
    fs::remove_all(folder / "constant/boundaryData", ignored);
    if (pulsatile) writer.write_boundary_data(folder, progress);
    write_file(folder / "system/fvSchemes", schemes(pulsatile, angle));
    write_file(folder / "system/fvSolution", solution(parameters, angle));
    write_file(folder / "system/decomposeParDict",
               decomposition_dictionary(bounds(mesh.points), parameters.processes));
    write_script(folder / "Allrun", script(pulsatile, false));
    write_script(folder / "Allrun.parallel", script(pulsatile, true));
    const std::string line = provenance.empty() ? "" : comment_line(provenance) + "\n";
    write_file(folder / "README", line + readme(mesh, parameters, writer.flows()));
    // Last: it makes the folder a case.
    write_file(folder / "system/controlDict",
               (line.empty() ? "" : "// " + line) + control_dictionary(writer.patches, parameters));
}

}  // namespace vesselbench
