#include "tests/flow/planted_flow.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "meshing/products/openfoam_case.h"
#include "meshing/products/openfoam_control.h"
#include "meshing/products/openfoam_mesh.h"
#include "meshing/tetrahedra/quality.h"
#include "workbench/flow/flow_record.h"

namespace vesselbench::test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLastLine =
    "\n// ************************************************************************* //\n";

void write_whole(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text << kLastLine;
}

std::string vector_text(const Vec3& v) {
    std::ostringstream text;
    text << std::setprecision(17) << "(" << v.x() << " " << v.y() << " " << v.z() << ")";
    return text.str();
}

std::string opening(const char* name, const std::string& value) {
    return std::string("    ") + name +
           "\n    {\n        type calculated;\n        value uniform " + value + ";\n    }\n";
}

std::string field(const std::string& kind, const std::string& name, const std::string& dimensions,
                  const std::string& rest, const std::string& wall) {
    return foam_header(kind, "60", name) + "dimensions " + dimensions +
           ";\ninternalField uniform " + rest +
           ";\nboundaryField\n{\n    wall\n    {\n        type calculated;\n        value " + wall +
           ";\n    }\n" + opening("inlet", rest) + opening("outlet_1", rest) + "}\n";
}

/// OpenFOAM's shear stress at the faces of the wall, in their order.
std::string wall_values(const VolumeMesh& mesh, const PlantedFlow& flow) {
    const std::vector<MeshFace> faces = mesh_faces(mesh, cell_neighbours(mesh, {}));
    std::string list;
    std::size_t count = 0;
    for (const MeshFace& face : faces) {
        if (face.neighbour != MeshFace::kOutside || face.patch != 0) continue;
        Vec3 middle = Vec3::Zero();
        for (const VertexId corner : face.corners)
            middle += mesh.points[corner] / static_cast<double>(face.corners.size());
        list += vector_text(flow.wall_shear(middle)) + "\n";
        ++count;
    }
    return "nonuniform List<vector>\n" + std::to_string(count) + "\n(\n" + list + ")\n";
}

void write_table(const std::string& folder, const std::string& name, const std::string& columns,
                 int iterations, const std::function<std::string(int)>& row) {
    const fs::path file = fs::path(folder) / "postProcessing" / name / "0" / "table.dat";
    fs::create_directories(file.parent_path());
    std::ofstream out(file);
    out << "# a table\n# Time \t" << columns << "\n";
    for (int k = 1; k <= iterations; ++k) out << k << "\t" << row(k) << "\n";
}

}  // namespace

void write_case(const std::string& folder, const VolumeMesh& mesh,
                const CfdParameters& parameters) {
    write_openfoam_case(folder, mesh, parameters);
    write_flow_record(folder, mesh, parameters, {.provenance = "a test"});
}

void plant_flow(const std::string& folder, const VolumeMesh& mesh, const PlantedFlow& flow) {
    const fs::path time = fs::path(folder) / std::to_string(flow.iterations);
    write_whole(time / "U",
                field("volVectorField", "U", "[0 1 -1 0 0 0 0]", "(0 0 0)", "uniform (0 0 0)"));
    write_whole(time / "p", field("volScalarField", "p", "[0 2 -2 0 0 0 0]", "0.5", "uniform 0.5"));
    write_whole(time / "phi", "");
    write_whole(time / "wallShearStress",
                field("volVectorField", "wallShearStress", "[0 2 -2 0 0 0 0]", "(0 0 0)",
                      wall_values(mesh, flow)));
    const auto same = [](double value) {
        std::ostringstream text;
        text << std::setprecision(17) << value;
        return [text = text.str()](int) { return text; };
    };
    const int count = flow.iterations;
    write_table(folder, "pressure_inlet", "areaAverage(p)", count, same(flow.pressure));
    write_table(folder, "pressure_outlet_1", "areaAverage(p)", count, same(0.0));
    write_table(folder, "flow_inlet", "sum(phi)", count, same(-flow.inflow));
    write_table(folder, "flow_outlet_1", "sum(phi)", count, same(flow.outflow));
    write_table(folder, "shear_wall", "areaAverage(wallShearStressMagnitude)", count, same(2e-3));
    write_table(folder, "residuals", "U_solver Ux_initial Uy_initial Uz_initial p_initial", count,
                [&](int k) {
                    const std::string r = std::to_string(flow.residual(k));
                    return "smoothSolver " + r + " " + r + " " + r + " " + r;
                });
}

}  // namespace vesselbench::test
